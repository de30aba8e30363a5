// What peers are said not to draw, from a scene's features alone; the peers need not be there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/measure/peers/povray_peer.h"
#include "tests/measure/peers/povray_scene.h"
#include "tests/measure/peers/scene_features.h"
#include "tests/measure/peers/tachyon_peer.h"
#include "tests/measure/peers/tachyon_scene.h"

namespace raytracer::peers {
namespace {

const std::string distant = R"({"type": "distant", "direction": [0, -1, 0.5]})";
const std::string point = R"({"type": "point", "position": [0, 9, 0], "intensity": 90})";

struct Parts {
  std::string light = distant;
  std::string material = R"("color": [0.5, 0.5, 0.5])";
  std::string object = R"("type": "sphere", "center": [0, 0, 0], "radius": 1)";
  std::string render = R"("samples": 4)";
  std::string shadows = "ambient";
};

Scene scene_of(const Parts& parts) {
  const std::string text =
      R"({"camera": {"origin": [0, 0, -8], "look_at": [0, 0, 0], "fov": 1, "width": 40, "height": 30},
  "shadows": ")" +
      parts.shadows + R"(", "lights": [)" + parts.light + R"(], "render": {)" + parts.render +
      R"(}, "objects": [{)" + parts.object + R"(, "material": {)" + parts.material + "}}]}";
  const Result<Scene> scene = read_scene(text, Limits{});
  EXPECT_TRUE(scene.ok()) << text;
  return scene.value();
}

struct PeerRefusal : testing::Test {
  const PovrayPeer povray{1};
  const TachyonPeer tachyon{1};
};
struct PeerDifferences : PeerRefusal {};

std::string refusal(const Peer& peer, const Parts& parts) {
  return peer.refusal(scene_of(parts)).value_or("");
}

TEST_F(PeerRefusal, plain_scene_is_refused_by_none) {
  for (const std::string shadows : {"black", "ambient", "off"}) {
    EXPECT_EQ(refusal(povray, {.shadows = shadows}), "");
    EXPECT_EQ(refusal(tachyon, {.shadows = shadows}), "");
  }
}

TEST_F(PeerRefusal, names_what_is_in_the_way) {
  const std::string item_colors =
      R"("type": "spheres", "centers": [[0, 0, 0]], "radius": 1, "colors": ["#ff0000"])";
  EXPECT_EQ(refusal(povray, {.object = item_colors}), "");
  EXPECT_EQ(refusal(tachyon, {.object = item_colors}), "sets with a colour for each item");
  EXPECT_EQ(refusal(povray, {.material = R"("shininess": 0)"}), "highlights of shininess 0");
  EXPECT_EQ(refusal(povray, {.material = R"("shininess": 0, "ks": 0)"}), "");
  EXPECT_EQ(refusal(povray, {.render = R"("samples": 3)"}),
            "a number of samples that is not a square");
}

TEST_F(PeerRefusal, is_about_what_occurs_together) {
  EXPECT_EQ(refusal(povray, {.light = point}), "");
  EXPECT_EQ(refusal(tachyon, {.light = point, .material = R"("ks": 0)"}), "");
  EXPECT_NE(refusal(tachyon, {.light = point}).find("highlights of point lights"),
            std::string::npos);
}

TEST_F(PeerRefusal, is_about_kinds_that_only_some_draw) {
  const std::string cone =
      R"("type": "cone", "from": [0, 0, 0], "to": [0, 1, 0], "radius_from": 1, "radius_to": 0)";
  EXPECT_EQ(refusal(povray, {.object = cone}), "");
  EXPECT_EQ(refusal(tachyon, {.object = cone}), "objects of type cone");
  const std::string glass = R"("transparency": 0.9)";
  EXPECT_EQ(refusal(povray, {.material = glass}), "");
  EXPECT_NE(refusal(tachyon, {.material = glass}).find("glass"), std::string::npos);
  const std::string unfading = R"({"type": "point", "position": [0, 9, 0], "falloff": "none"})";
  EXPECT_EQ(refusal(tachyon, {.light = unfading}), "");
}

TEST_F(PeerRefusal, tells_soft_lights_from_hard_ones) {
  const Parts sky{.light = R"({"type": "sky"})"};
  EXPECT_EQ(refusal(tachyon, sky), "");
  EXPECT_EQ(refusal(povray, sky), "lights of type sky");
  EXPECT_EQ(refusal(tachyon, {.light = R"({"type": "sky", "reach": 2})"}),
            "lights of type sky with a reach");
  const std::string wide = R"({"type": "distant", "direction": [0, -1, 0], "angle": 0.1})";
  EXPECT_EQ(refusal(povray, {.light = wide}), "lights of type distant with an angle");
}

TEST(SceneFeatures, type_that_no_peer_was_taught_is_unknown) {
  EXPECT_EQ(first_unknown({"sphere", "teapot"}, {"sphere", "plane"}, "objects"),
            "objects of type teapot");
  EXPECT_EQ(first_unknown({"sphere"}, {"sphere", "plane"}, "objects"), std::nullopt);
}

TEST_F(PeerDifferences, ambient_light_is_left_out_where_it_comes_from_each_light) {
  for (const Peer* const peer :
       {static_cast<const Peer*>(&povray), static_cast<const Peer*>(&tachyon)}) {
    EXPECT_TRUE(peer->omits_ambient(scene_of({.shadows = "black"})));
    EXPECT_FALSE(peer->omits_ambient(scene_of({.shadows = "ambient"})));
    EXPECT_FALSE(peer->omits_ambient(scene_of({.material = R"("ka": 0)", .shadows = "black"})));
    EXPECT_EQ(scene_drawn(*peer, scene_of({.shadows = "black"})).ambient, 0);
  }
}

TEST_F(PeerDifferences, coloured_highlights_are_exact_under_one_white_light) {
  const std::string red = R"("color": [0.9, 0.2, 0.1])";
  const std::string two =
      distant + "," + R"({"type": "distant", "direction": [1, -1, 0], "intensity": 0.5})";
  const std::string one_sample = R"("samples": 1)";
  EXPECT_TRUE(tachyon.differences(scene_of({.material = red, .render = one_sample})).empty());
  EXPECT_EQ(
      tachyon.differences(scene_of({.light = two, .material = red, .render = one_sample})).size(),
      1U);
  EXPECT_TRUE(tachyon.differences(scene_of({.light = two, .render = one_sample})).empty());
}

TEST(PovrayScene, light_of_its_own_makes_up_for_what_glass_lets_through) {
  std::ostringstream text;
  write_povray_scene(scene_of({.material = R"("kd": 0.2, "transparency": 0.75, "ior": 1.4)"}),
                     text);
  EXPECT_NE(text.str().find("transmit 0.75"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find(fmt::format("diffuse {:.17g}", 0.2 / 0.25)), std::string::npos)
      << text.str();
  EXPECT_NE(text.str().find("interior { ior 1.3999999999999999 }"), std::string::npos)
      << text.str();
}

TEST(TachyonScene, takes_highlights_for_the_colour_of_light_or_surface) {
  const auto text_of = [](const Parts& parts) {
    std::ostringstream text;
    write_tachyon_scene(scene_of(parts), text);
    return text.str();
  };
  EXPECT_NE(text_of({}).find("PHONG PLASTIC 0.15 "), std::string::npos) << text_of({});
  const std::string red = text_of({.material = R"("color": [1, 0, 0])"});
  EXPECT_NE(red.find("PHONG METAL 0.3 "), std::string::npos) << red;
  const std::string no_mirrors =
      text_of({.material = R"("reflectivity": 1)", .render = R"("max_depth": 0)"});
  EXPECT_NE(no_mirrors.find(" SPECULAR 0 "), std::string::npos) << no_mirrors;
}

}  // namespace
}  // namespace raytracer::peers

// The canonical bytes: equal for what means the same picture, and for nothing else.

#include <gtest/gtest.h>

#include <set>

#include "engine/scene/path.h"
#include "tests/scene/full_document.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

std::string bytes_of(std::string_view text) {
  const Scene scene = scene_of_text(text);
  return canonical_content(scene) + canonical_view(scene);
}

constexpr const char* plain = R"({
  "camera": {"origin": [0, 0, 0], "look_at": [0, 0, 5], "fov": 1, "width": 7, "height": 5},
  "materials": {"red": {"color": "#ff0000"}},
  "objects": [{"type": "sphere", "center": [0, 0, 5], "radius": 1, "material": "red"}],
  "lights": [{"type": "distant", "direction": [0, -1, 0]}]})";

TEST(CanonicalBytes, do_not_depend_on_how_the_document_is_written) {
  const std::string spelled_out = bytes_of(R"({"name":"x","description":"y","$schema":"z",
    "render":{"max_depth":5.0,"samples":1,"precision":"auto","transfer":"linear"},
    "lights":[{"intensity":1e0,"color":"#FFFFFF","direction":[0,-1.0,-0.0],"type":"distant"}],
    "objects":[{"radius":1.00,"material":{"color":[1,0,0],"ka":1,"kd":0.7,"ks":0.3,"shininess":50,
                "reflectivity":0},"center":[0,0,5],"type":"sphere"}],
    "materials":{"unused":{"kd":0.1},"blue":{}},
    "shadows":"black","ambient":0.2,"background":"#000000",
    "camera":{"height":5,"width":7,"fov":1,"up":[0,1,0],"look_at":[0,0,5],"origin":[0,0,-0.0]}})");
  EXPECT_EQ(bytes_of(plain), spelled_out);
}

TEST(CanonicalBytes, do_not_depend_on_materials_names_or_order) {
  json first = json::parse(plain);
  first["materials"] = {{"a", {{"kd", 0.1}}}, {"b", {{"kd", 0.2}}}};
  first["objects"] = {sphere_json({0, 0, 5}, 1, "a"), sphere_json({0, 0, 6}, 1, "b")};
  json second = first;
  second["materials"] = {{"a", {{"kd", 0.2}}}, {"b", {{"kd", 0.1}}}};
  second["objects"] = {sphere_json({0, 0, 5}, 1, "b"), sphere_json({0, 0, 6}, 1, "a")};
  EXPECT_EQ(bytes_of(first.dump()), bytes_of(second.dump()));
}

TEST(CanonicalBytes, differ_for_every_value_that_can_change_a_pixel) {
  std::set<std::string> seen{bytes_of(plain)};
  const auto expect_new = [&](const char* pointer, const json& value) {
    json text = json::parse(plain);
    text[json::json_pointer(pointer)] = value;
    EXPECT_TRUE(seen.insert(bytes_of(text.dump())).second) << pointer << ' ' << value;
  };
  expect_new("/camera/origin", {0, 0, 1e-9});
  expect_new("/camera/look_at", {0, 1e-9, 5});
  expect_new("/camera/up", {0, 1, 1e-9});
  expect_new("/camera/fov", 1.0000000000000002);
  expect_new("/camera/width", 8);
  expect_new("/camera/height", 6);
  expect_new("/background", {0, 0, 0.5});
  expect_new("/background", "transparent");
  expect_new("/ambient", 0.25);
  expect_new("/shadows", "ambient");
  expect_new("/shadows", "off");
  expect_new("/lights", json::array());
  expect_new("/lights/0/direction", {0, -1, 1e-9});
  expect_new("/lights/0/color", {1, 1, 0.5});
  expect_new("/lights/0/intensity", 2);
  json lamp{{"type", "point"}, {"position", {0, 0, 0}}};
  expect_new("/lights/0", lamp);
  lamp["falloff"] = "none";
  expect_new("/lights/0", lamp);
  lamp["radius"] = 0.1;
  expect_new("/lights/0", lamp);
  expect_new("/lights/0/angle", 0.1);
  expect_new("/lights/0", {{"type", "sky"}});
  expect_new("/lights/0", {{"type", "sky"}, {"reach", 2}});
  expect_new("/lights/0", {{"type", "point"}, {"position", {0, -1, 0}}});
  expect_new("/materials/red/color", "#fe0000");
  expect_new("/materials/red/ka", 0.5);
  expect_new("/materials/red/kd", 0.5);
  expect_new("/materials/red/ks", 0.5);
  expect_new("/materials/red/shininess", 51);
  expect_new("/materials/red/reflectivity", 0.5);
  expect_new("/materials/red/transparency", 0.5);
  expect_new("/materials/red/ior", 1.25);
  expect_new("/materials/red/fresnel", true);
  expect_new("/objects", json::array());
  expect_new("/objects/0/center", {0, 0, 6});
  expect_new("/objects/0/radius", 2);
  expect_new("/objects/0/material", json::object());
  expect_new("/objects/0", plane_json({0, 0, 5}, {1, 0, 0}, "red"));
  expect_new("/objects/0", square_json({0, 0, 5}, 1, 1, "xz", "red"));
  expect_new("/objects/0", square_json({0, 0, 5}, 1, 2, "xz", "red"));
  expect_new("/objects/0", square_json({0, 0, 5}, 1, 1, "yz", "red"));
  expect_new("/objects/0", mesh_json({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}, {{0, 1, 2}}, "red"));
  expect_new("/objects/0", mesh_json({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}, {{0, 2, 1}}, "red"));
  json spheres{{"type", "spheres"}, {"centers", {{0, 0, 5}, {0, 0, 6}}}, {"radius", 1}};
  expect_new("/objects/0", spheres);
  spheres["colors"] = {"#ff0000", "#00ff00"};
  expect_new("/objects/0", spheres);
  spheres["colors"] = {"#00ff00", "#ff0000"};
  expect_new("/objects/0", spheres);
  const auto expect_cylinder = [&](json object, const char* key, const json& value) {
    object[key] = value;
    expect_new("/objects/0", object);
  };
  const json one{{"type", "cylinder"}, {"from", {0, 0, 5}}, {"to", {0, 1, 5}}, {"radius", 1}};
  expect_new("/objects/0", one);
  expect_cylinder(one, "from", {0, 0, 6});
  expect_cylinder(one, "to", {0, 0, 6});
  expect_cylinder(one, "radius", 2);
  expect_cylinder(one, "caps", false);
  expect_cylinder(one, "material", "red");
  const json many{{"type", "cylinders"},
                  {"from", {{0, 0, 5}, {1, 0, 5}}},
                  {"to", {{0, 1, 5}, {1, 1, 5}}},
                  {"radius", 1}};
  expect_new("/objects/0", many);
  expect_cylinder(many, "from", {{1, 0, 5}, {0, 0, 5}});
  expect_cylinder(many, "to", {{1, 1, 5}, {0, 1, 5}});
  expect_cylinder(many, "radius", 2);
  expect_cylinder(many, "radius", {1, 2});
  expect_cylinder(many, "radius", {2, 1});
  expect_cylinder(many, "caps", false);
  expect_cylinder(many, "colors", {"#ff0000", "#00ff00"});
  expect_cylinder(many, "colors", {"#00ff00", "#ff0000"});
  expect_new("/render/samples", 2);
  expect_new("/render/max_depth", 6);
  expect_new("/render/transfer", "srgb");
  expect_new("/render/precision", "single");
  expect_new("/render/target_rmse", 0.5);
  expect_new("/render/budget_ms", 0.5);
}

TEST(CanonicalBytes, of_many_spheres_with_one_radius_equal_those_with_the_radius_spelled_out) {
  json text = json::parse(plain);
  text["objects"][0] = {{"type", "spheres"}, {"centers", {{0, 0, 5}, {0, 0, 6}}}, {"radius", 2}};
  const std::string once = bytes_of(text.dump());
  text["objects"][0]["radius"] = {2, 2};
  EXPECT_EQ(bytes_of(text.dump()), once);
}

TEST(CanonicalBytes, of_a_mesh_have_its_corners_normals_and_colors) {
  const std::string bytes = bytes_of(full_document().dump());
  for (const char* key : {"normals", "colors"}) {
    json text = full_document();
    std::swap(text["objects"][4][key][0], text["objects"][4][key][1]);
    EXPECT_NE(bytes_of(text.dump()), bytes) << key;
    text["objects"][4].erase(key);
    EXPECT_NE(bytes_of(text.dump()), bytes) << key;
  }
}

TEST(CanonicalBytes, of_cylinders_do_not_depend_on_what_is_spelled_out) {
  json text = json::parse(plain);
  text["objects"] = {{{"type", "cylinder"}, {"from", {0, 0, 5}}, {"to", {0, 1, 5}}, {"radius", 1}},
                     {{"type", "cylinders"},
                      {"from", {{0, 0, 5}, {1, 0, 5}}},
                      {"to", {{0, 1, 5}, {1, 1, 5}}},
                      {"radius", 2}}};
  const std::string once = bytes_of(text.dump());
  for (json& object : text["objects"]) object["caps"] = true;
  text["objects"][1]["radius"] = {2, 2};
  EXPECT_EQ(bytes_of(text.dump()), once);
}

TEST(NearestKey, is_that_of_the_least_edit_distance_and_the_first_of_equals) {
  constexpr std::array<std::string_view, 4> words{"radius", "center", "centers", "n"};
  EXPECT_EQ(nearest_key("raduis", words), "radius");
  EXPECT_EQ(nearest_key("radius", words), "radius");
  EXPECT_EQ(nearest_key("centre", words), "center");
  EXPECT_EQ(nearest_key("RADIUS", words), "radius");
  EXPECT_EQ(nearest_key("centerss", words), "centers");
  EXPECT_EQ(nearest_key("m", words), "n");
  EXPECT_EQ(nearest_key("", words), "n");
  constexpr std::array<std::string_view, 2> equals{"ab", "cb"};
  EXPECT_EQ(nearest_key("xb", equals), "ab");
  EXPECT_EQ(nearest_key("word", std::span<const std::string_view>{}), "");
  EXPECT_EQ(did_you_mean("raduis", words), "; did you mean \"radius\"?");
  EXPECT_EQ(did_you_mean("torus", words), "");
  EXPECT_EQ(did_you_mean("word", std::span<const std::string_view>{}), "");
}

TEST(NearestKey, to_a_very_long_word_is_found_at_once) {
  constexpr std::array<std::string_view, 2> words{"radius", "center"};
  EXPECT_NE(nearest_key(std::string(5'000'000, 'c'), words), "");
}

TEST(Path, escapes_tilde_and_slash) {
  const Path root;
  const Path materials = root.child("a~b/c");
  const Path element = materials.child(std::size_t{12});
  EXPECT_EQ(root.pointer(), "");
  EXPECT_EQ(materials.pointer(), "/a~0b~1c");
  EXPECT_EQ(element.pointer(), "/a~0b~1c/12");
  EXPECT_EQ(root.child("").pointer(), "/");
  EXPECT_EQ(root.child("~1").pointer(), "/~01");
}

}  // namespace
}  // namespace raytracer::test

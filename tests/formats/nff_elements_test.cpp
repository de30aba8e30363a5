// Each element of NFF becomes what it means in a scene document: with x mirrored, for NFF counts in
// right-handed coordinates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "client/failure.h"
#include "tests/formats/nff_document.h"
#include "tests/support/cpu_stopwatch.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

TEST(NffElements, viewpoint_becomes_the_camera) {
  const json camera = nff_document(nff_view).at("camera");
  EXPECT_EQ(camera.at("origin"), json({-1, 2, 3}));
  EXPECT_EQ(camera.at("look_at"), json({0, 0, 0}));
  EXPECT_EQ(camera.at("up"), json({0, 0, 1}));
  EXPECT_EQ(camera.at("fov"), std::numbers::pi / 2);
  EXPECT_EQ(camera.at("width"), 100);
  EXPECT_EQ(camera.at("height"), 100);
}

TEST(NffElements, angle_is_vertical_where_the_image_is_not_square) {
  const auto fov = [](const std::string& resolution) {
    return nff_document("v from 1 2 3 at 0 0 0 up 0 0 1 angle 60 resolution " + resolution)
        .at("camera")
        .at("fov")
        .get<double>();
  };
  const double tangent = std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(fov("200 100"), 2 * std::atan(2 * tangent), 1e-15);
  EXPECT_NEAR(fov("100 200"), 2 * std::atan(tangent / 2), 1e-15);
}

TEST(NffElements, parts_of_the_viewpoint_stand_in_any_order_and_on_one_line) {
  EXPECT_EQ(nff_document("v resolution 100 100 angle 90 up 0 0 1 at 0 0 0 from 1 2 3"),
            nff_document(nff_view));
}

TEST(NffElements, background_is_black_unless_it_is_said) {
  EXPECT_EQ(nff_document(nff_view).at("background"), json({0, 0, 0}));
  EXPECT_EQ(nff_document(nff_view + "b 0.1 0.2 1").at("background"), json({0.1, 0.2, 1}));
}

TEST(NffElements, nothing_is_lit_but_by_lights) {
  EXPECT_EQ(nff_document(nff_view + "l 1 2 3").at("ambient"), 0);
}

TEST(NffElements, what_has_no_light_has_a_key_light_and_a_sky) {
  const json lights = nff_document(nff_view).at("lights");
  ASSERT_EQ(lights.size(), 2U);
  EXPECT_EQ(lights[0].at("type"), "distant");
  EXPECT_EQ(lights[1].at("type"), "sky");
  // Upward along the line of sight is no direction, and another stands in for it.
  const json along = nff_document("v from 0 0 5 at 0 0 0 up 0 0 2 angle 90 resolution 9 9");
  for (const json& part : along.at("lights")[0].at("direction")) EXPECT_TRUE(part.is_number());
}

TEST(NffElements, what_has_no_viewpoint_is_all_in_view_as_is_asked) {
  const std::string balls = nff_fill + "s 1 2 3 0.5\ns 4 2 3 0.5\nl 0 0 9";
  const json centre = nff_document(balls).at("camera").at("look_at");
  EXPECT_NEAR(centre[0].get<double>(), -2.5, 0.1);
  client::ImportOptions options;
  options.view = {0, 1, 0};
  const client::Reading reading = client::read_nff(balls, options);
  ASSERT_TRUE(reading.errors.empty());
  EXPECT_EQ(reading.scene.view.from[0], 2.5);  // as the file counts
  EXPECT_GT(reading.scene.view.from[1], 5);
  EXPECT_NEAR(reading.scene.view.from[2], 3, 1e-9);
}

TEST(NffElements, view_that_is_asked_for_stands_against_the_viewpoint) {
  client::ImportOptions options;
  options.zoom = 2;
  EXPECT_THROW(client::read_nff(nff_view, options), client::InputError);
}

TEST(NffElements, lights_share_their_strength_and_have_no_falloff) {
  const json lights = nff_document(nff_view + "l 1 2 3\nl 4 5 6\nl 0 0 7\nl 0 0 8").at("lights");
  ASSERT_EQ(lights.size(), 4U);
  EXPECT_EQ(lights[1], json({{"type", "point"},
                             {"position", {-4, 5, 6}},
                             {"color", {1, 1, 1}},
                             {"intensity", 0.5},
                             {"falloff", "none"}}));
}

TEST(NffElements, light_with_a_colour_is_as_strong_as_it_says) {
  const json lights = nff_document(nff_view + "l 1 2 3 0.5 0.25 0\nl 1 2 3 2 4 1").at("lights");
  ASSERT_EQ(lights.size(), 2U);
  EXPECT_EQ(lights[0].at("color"), json({0.5, 0.25, 0}));
  EXPECT_EQ(lights[0].at("intensity"), 1);
  EXPECT_EQ(lights[1].at("color"), json({0.5, 1, 0.25}));
  EXPECT_EQ(lights[1].at("intensity"), 4);
}

TEST(NffElements, fill_becomes_a_material_that_mirrors_by_ks) {
  const json document = nff_document(nff_view +
                                     "f 0.1 0.2 0.3 0.8 0.4 10 0 0\ns 0 0 0 1\n"
                                     "f 1 1 1 0.1 0.2 25 0.7 1.5\ns 3 0 0 1");
  EXPECT_EQ(document.at("materials").at("fill1"), json({{"color", {0.1, 0.2, 0.3}},
                                                        {"kd", 0.8},
                                                        {"ks", 0.4},
                                                        {"shininess", 40},
                                                        {"reflectivity", 0.4}}));
  EXPECT_EQ(document.at("materials").at("fill2"), json({{"color", {1, 1, 1}},
                                                        {"kd", 0.1},
                                                        {"ks", 0.2},
                                                        {"shininess", 100},
                                                        {"reflectivity", 0.2},
                                                        {"transparency", 0.7},
                                                        {"ior", 1.5}}));
  EXPECT_EQ(document.at("objects")[0].at("material"), "fill1");
  EXPECT_EQ(document.at("objects")[1].at("material"), "fill2");
}

/// Halfway down the highlight, seen along the mirrored ray's plane.
TEST(NffElements, highlight_is_as_wide_as_phong_makes_it) {
  const double shine = 20;
  const double shininess = nff_document(nff_view + "f 1 1 1 0 1 20 0 0\ns 0 0 0 1")
                               .at("materials")
                               .at("fill1")
                               .at("shininess");
  const double off_mirror = std::acos(std::pow(0.5, 1 / shine));
  EXPECT_NEAR(std::pow(std::cos(off_mirror / 2), shininess), 0.5, 0.01);
}

TEST(NffElements, single_objects_stand_by_themselves) {
  EXPECT_EQ(
      nff_objects("s 1 2 3 4")[0],
      json({{"type", "sphere"}, {"center", {-1, 2, 3}}, {"radius", 4}, {"material", "fill1"}}));
  EXPECT_EQ(nff_objects("c\n1 2 3 4\n5 6 7 4")[0], json({{"type", "cylinder"},
                                                         {"from", {-1, 2, 3}},
                                                         {"to", {-5, 6, 7}},
                                                         {"radius", 4},
                                                         {"caps", false},
                                                         {"material", "fill1"}}));
  EXPECT_EQ(nff_objects("c\n1 2 3 4\n5 6 7 0")[0], json({{"type", "cone"},
                                                         {"from", {-1, 2, 3}},
                                                         {"to", {-5, 6, 7}},
                                                         {"radius_from", 4},
                                                         {"radius_to", 0},
                                                         {"caps", false},
                                                         {"material", "fill1"}}));
}

TEST(NffElements, objects_of_a_kind_and_fill_become_one_in_their_order) {
  const std::string other_fill = "f 0 0 1 1 0 1 0 0\n";
  const json objects =
      nff_objects("s 1 0 0 1\nc 0 0 0 1 1 0 0 1\ns 2 0 0 1\n" + other_fill + "s 3 0 0 1\n" +
                  nff_fill + "s 4 0 0 2\nc 0 0 0 2 1 0 0 1\nc 0 0 0 2 1 0 0 0\n");
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(objects[0].at("type"), "spheres");
  EXPECT_EQ(objects[0].at("centers"), json({{-1, 0, 0}, {-2, 0, 0}, {-4, 0, 0}}));
  EXPECT_EQ(objects[0].at("radius"), json({1, 1, 2}));
  EXPECT_EQ(objects[1].at("type"), "cylinder");
  EXPECT_EQ(objects[2].at("type"), "cones");
  EXPECT_EQ(objects[2].at("radius_from"), 2);
  EXPECT_EQ(objects[2].at("radius_to"), json({1, 0}));
  EXPECT_EQ(objects[3].at("center"), json({-3, 0, 0}));
  EXPECT_EQ(objects[3].at("material"), "fill2");
}

/// The sign of x and the order of corners change: the normal stays outside.
TEST(NffElements, polygons_become_a_mesh_with_common_corners) {
  const json objects = nff_objects("p 3\n0 0 0\n1 0 0\n0 1 0\np 3\n1 0 0\n1 1 0\n0 1 0\n");
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].at("type"), "mesh");
  EXPECT_EQ(objects[0].at("vertices").size(), 4U);
  EXPECT_EQ(objects[0].at("triangles").size(), 2U);
  EXPECT_FALSE(objects[0].contains("normals"));
  const json& vertices = objects[0].at("vertices");
  for (const json& triangle : objects[0].at("triangles")) {
    const auto corner = [&](int i, int axis) {
      return vertices[triangle[static_cast<std::size_t>(i)].get<std::size_t>()]
                     [static_cast<std::size_t>(axis)]
                         .get<double>();
    };
    EXPECT_GT((corner(1, 0) - corner(0, 0)) * (corner(2, 1) - corner(0, 1)) -
                  (corner(1, 1) - corner(0, 1)) * (corner(2, 0) - corner(0, 0)),
              0);
  }
}

TEST(NffElements, patch_keeps_its_normals) {
  const json objects =
      nff_objects("pp 3\n1 0 0 1 0 2\n2 0 0 0 1 2\n1 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_FALSE(objects[0].contains("normals"));
  const json& patch = objects[1];
  ASSERT_EQ(patch.at("normals").size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    if (patch.at("vertices")[i] == json({-2, 0, 0})) {
      EXPECT_EQ(patch.at("normals")[i], json({0, 1, 2}));
    }
}

TEST(NffElements, corner_with_two_normals_is_two_vertices) {
  const json objects = nff_objects(
      "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\npp 3\n0 0 0 0 1 0\n0 0 1 0 0 1\n1 0 0 0 0 1\n");
  EXPECT_EQ(objects[0].at("vertices").size(), 5U);
}

TEST(NffElements, comments_and_white_space_are_free) {
  EXPECT_EQ(nff_document("# nothing\n" + nff_view + nff_fill + "s 1 2\r\n# between\n\t3 4# after"),
            nff_document(nff_view + nff_fill + "s 1 2 3 4"));
}

TEST(NffElements, numbers_are_kept_to_the_last_digit) {
  EXPECT_EQ(nff_objects("s 0.1 -2.55836e-17 +1e300 .5")[0].at("center"),
            json({-0.1, -2.55836e-17, 1e300}));
}

TEST(NffElements, hundred_thousand_are_a_short_document_at_once) {
  std::string text = nff_view + nff_fill;
  constexpr std::array forms{"s {0} 0.25 0.125 0.5\n", "c\n{0} 0 0 0.5\n{0} 1 0 0.25\n",
                             "p 3\n{0} 0 0\n{0} 1 0\n{0} 0 1\n",
                             "pp 3\n{0} 0 0 1 0 0\n{0} 1 0 1 0 0\n{0} 0 1 1 0 0\n"};
  for (std::size_t i = 0; i < 100'000; ++i)
    text += fmt::format(fmt::runtime(forms[i % forms.size()]), i);
  const CpuStopwatch time;
  const std::string document = client::model::to_document(client::read_nff(text).scene);
  EXPECT_LT(time.elapsed_ms(), 2000);
  EXPECT_EQ(json::parse(document).at("objects").size(), 4U);
  EXPECT_LT(document.size(), 3 * text.size());
}

}  // namespace
}  // namespace raytracer::test

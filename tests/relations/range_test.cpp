// Sizes so different that no arithmetic holds all of them: what is left out is as if it was not
// there, and what is too small for the eye is not seen.

#include <gtest/gtest.h>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/relations/varied_scene.h"
#include "tests/support/scene_plan.h"

namespace raytracer::test {
namespace {

/// Spheres of all kinds and a triangle, of `size` and around the coordinates' origin.
std::vector<json> small_things(double size) {
  json centers = json::array();
  for (int i = 0; i < 40; ++i) centers.push_back({size * i, 0, 0});
  return {sphere_json({}, size, {{"reflectivity", 0.5}}),
          {{"type", "spheres"}, {"centers", centers}, {"radius", size}},
          square_json({}, size, 3),
          mesh_json({{size, 0, 0}, {0, size, 0}, {0, 0, size}}, {{0, 1, 2}})};
}

class Range : public testing::TestWithParam<std::string> {};

TEST_P(Range, what_the_frame_cannot_carry_is_as_if_it_was_not_there) {
  json with = varied_scene();
  with["render"] = {{"precision", GetParam()}};
  const json without = with;
  for (const json& object : small_things(1e-160)) with["objects"].push_back(object);
  EXPECT_EQ(image_of(with).values, image_of(without).values);
}

TEST_P(Range, a_mirror_shows_nothing_where_all_spheres_are_left_out) {
  json text = document(camera_json(24, 18, 1, {0, 1, -7}, {}),
                       {plane_json({0, -1, 0}, {0, 1, 0}, {{"reflectivity", 0.5}})},
                       {distant_json({-1, -1, 2}), point_json({3, 4, -2}, 8)});
  text["render"] = {{"precision", GetParam()}};
  const json without = text;
  for (const json& object : small_things(1e-160)) text["objects"].push_back(object);
  const Image image = image_of(text);
  const Image expected = image_of(without);
  // Not the same values: what is not there may still be why "auto" is double.
  for (std::size_t i = 0; i < image.values.size(); ++i)
    ASSERT_NEAR(image.values[i], expected.values[i], 0.5 / 255) << i;
}

TEST_P(Range, nothing_is_seen_where_all_is_too_small_for_the_farthest_light) {
  json text = document(camera_json(24, 18, 1, {0, 1, -7}, {}), small_things(1e-260),
                       {point_json({-8, 12, 4e177}, 8), distant_json({0, -1, 1})});
  text["background"] = {0.25, 0.5, 1};
  text["render"] = {{"precision", GetParam()}};
  for (const float value : image_of(text).values) ASSERT_GE(value, 0.25F);
}

TEST_P(Range, spheres_of_a_square_too_small_for_the_squares_of_singles_are_not_seen) {
  json text = document(camera_json(24, 18, 3, {1.25, 0.125, -7.375}, {0, 0, -8.375}),
                       {square_json({1, 0, -8.375}, 3.7e-72, 1)}, {distant_json({0, -1, 0})});
  text["background"] = {0.25, 0.5, 1};
  text["render"] = {{"precision", GetParam()}};
  for (const float value : image_of(text).values) ASSERT_GE(value, 0.25F);
}

TEST_P(Range, a_triangle_whose_corners_are_one_place_from_afar_is_not_seen) {
  for (const bool is_inside : {false, true}) {
    json text = document(camera_json(48, 36, 0.6, {1e18, 1e18, 1e18}, {}),
                         {mesh_json({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})},
                         {distant_json({-1, -1, -1})});
    if (is_inside)
      text["objects"].push_back(sphere_json({1e18, 1e18, 1e18}, 1e19, constant_material({})));
    text["render"] = {{"precision", GetParam()}};
    EXPECT_EQ(count_lit(image_of(text)), 0) << is_inside;
  }
}

INSTANTIATE_TEST_SUITE_P(Precision, Range, testing::Values("auto", "single", "double"),
                         [](const auto& precision) { return precision.param; });

TEST(Range, single_is_refused_where_it_holds_no_square_of_a_radius) {
  json text =
      document(camera_json(), {sphere_json({0, 0, 1e-20}, 1e-21), sphere_json({0, 0, 9}, 1)});
  text["render"] = {{"precision", "single"}};
  const Plan plan = make_plan(scene_of(text), this_machine(1));
  EXPECT_EQ(plan.precision.value, Precision::double_precision);
  EXPECT_NE(plan.precision.reason().find("does not hold"), std::string::npos);
}

// In single the sphere would have no size beside the light's distance.
TEST(Range, a_very_far_light_shines_as_in_double) {
  json text = document(camera_json(32, 24, 0.9, {0, 1, -6}, {}), {sphere_json({-1, 0, 0}, 1)},
                       {point_json({0, 1e30, -1e30}, 8e60)});
  text["render"] = {{"precision", "double"}};
  const Image exact = image_of(text);
  EXPECT_GT(count_lit(exact), 50);
  text["render"] = {{"precision", "auto"}};
  EXPECT_EQ(image_of(text).values, exact.values);
}

}  // namespace
}  // namespace raytracer::test

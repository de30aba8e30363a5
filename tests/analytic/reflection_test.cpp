// Mirrors: how much, how often, and in which direction.

#include <gtest/gtest.h>

#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

json mirror(double reflectivity) {
  return {{"ka", 1}, {"kd", 0}, {"ks", 0}, {"reflectivity", reflectivity}};
}

TEST(Reflection, of_the_background_needs_a_depth_of_one) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(0.5))});
  text["background"] = {0.2, 0.4, 0.8};
  text["render"]["max_depth"] = 0;
  expect_exact_color(text, {0, 0, 0});
  for (const int depth : {1, 2, 100}) {
    text["render"]["max_depth"] = depth;
    expect_color(text, {0.1, 0.2, 0.4});
  }
}

TEST(Reflection, between_facing_mirrors_is_a_geometric_series) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(0.5)),
                                       plane_json({0, 0, -3}, {0, 0, 1}, mirror(0.5))});
  text["shadows"] = "ambient";
  text["ambient"] = 0.3;
  text["background"] = {1, 1, 1};  // is never seen
  double expected = 0;
  for (int depth = 0; depth <= 10; ++depth) {
    expected += 0.3 * std::pow(0.5, depth);
    text["render"]["max_depth"] = depth;
    expect_gray(text, expected);
  }
}

TEST(Reflection, of_a_perfect_mirror_pair_ends_at_max_depth) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(1)),
                                       plane_json({0, 0, -3}, {0, 0, 1}, mirror(1))});
  text["shadows"] = "ambient";
  text["ambient"] = 0.001;
  for (const int depth : {0, 1, 5, 500}) {
    text["render"]["max_depth"] = depth;
    expect_gray(text, 0.001 * (depth + 1));
  }
}

TEST(Reflection, leaves_at_the_angle_of_incidence) {
  // The ray along +z meets a mirror of normal (1, 0, -1) and leaves along +x.
  json text = document(camera_json(), {plane_json({0, 0, 5}, {1, 0, -1}, mirror(1)),
                                       sphere_json({4, 0, 5}, 0.1, mirror(0))});
  text["shadows"] = "ambient";
  text["objects"][0]["material"]["ka"] = 0;
  expect_gray(text, 0.2);
  text["objects"][1]["center"] = {4, 0.2, 5};
  expect_gray(text, 0);
  text["objects"][1]["center"] = {-4, 0, 5};
  expect_gray(text, 0);
}

TEST(Reflection, inside_a_sphere_comes_back_to_its_centre) {
  json text = document(camera_json(), {sphere_json({0, 0, 0}, 2, mirror(0.5))});
  text["shadows"] = "ambient";
  text["ambient"] = 0.4;
  text["render"]["max_depth"] = 2;
  expect_gray(text, 0.4 * 1.75);
}

TEST(Reflection, is_not_tinted_by_the_mirrors_color) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(0.5))});
  text["objects"][0]["material"]["color"] = {1, 0, 0};
  text["background"] = {0.5, 0.5, 0.5};
  expect_gray(text, 0.25);
}

TEST(Reflection, sees_the_lit_side_of_what_is_behind_the_camera) {
  json text = document(camera_json(),
                       {plane_json({0, 0, 5}, {0, 0, 1}, mirror(0.5)),
                        sphere_json({0, 0, -5}, 1, diffuse_material())},
                       {distant_json({0, 0, -1}, 0.8)});
  // The sphere's near side faces +z and the light. The mirror is lit from behind: dark itself.
  expect_gray(text, 0.5 * 0);  // the mirror stands in the light's way
  text["shadows"] = "off";
  text["objects"][0]["material"]["ka"] = 0;
  expect_gray(text, 0.5 * 0.8);
}

}  // namespace
}  // namespace raytracer::test

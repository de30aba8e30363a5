// Mirrors: how much, how often, and in which direction.

#include <gtest/gtest.h>

#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

json mirror(double reflectivity) {
  return {{"ka", 1}, {"kd", 0}, {"ks", 0}, {"reflectivity", reflectivity}};
}

TEST(Reflection, OfTheBackgroundNeedsADepthOfOne) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(0.5))});
  text["background"] = {0.2, 0.4, 0.8};
  text["render"]["max_depth"] = 0;
  expect_exact_color(text, {0, 0, 0});
  for (const int depth : {1, 2, 100}) {
    text["render"]["max_depth"] = depth;
    expect_color(text, {0.1, 0.2, 0.4});
  }
}

TEST(Reflection, BetweenFacingMirrorsIsAGeometricSeries) {
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

TEST(Reflection, OfAPerfectMirrorPairEndsAtMaxDepth) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(1)),
                                       plane_json({0, 0, -3}, {0, 0, 1}, mirror(1))});
  text["shadows"] = "ambient";
  text["ambient"] = 0.001;
  for (const int depth : {0, 1, 5, 500}) {
    text["render"]["max_depth"] = depth;
    expect_gray(text, 0.001 * (depth + 1));
  }
}

TEST(Reflection, LeavesAtTheAngleOfIncidence) {
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

TEST(Reflection, InsideASphereComesBackToItsCentre) {
  json text = document(camera_json(), {sphere_json({0, 0, 0}, 2, mirror(0.5))});
  text["shadows"] = "ambient";
  text["ambient"] = 0.4;
  text["render"]["max_depth"] = 2;
  expect_gray(text, 0.4 * 1.75);
}

TEST(Reflection, IsNotTintedByTheMirrorsColor) {
  json text = document(camera_json(), {plane_json({0, 0, 5}, {0, 0, 1}, mirror(0.5))});
  text["objects"][0]["material"]["color"] = {1, 0, 0};
  text["background"] = {0.5, 0.5, 0.5};
  expect_gray(text, 0.25);
}

TEST(Reflection, SeesTheLitSideOfWhatIsBehindTheCamera) {
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

// Colours integrated along lines against closed forms: what covers a pixel, and what light leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr double pi = std::numbers::pi;

json with_target(json text, double target_rmse, const char* precision) {
  text["render"] = {{"target_rmse", target_rmse}, {"precision", precision}};
  return text;
}

double sum_of(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3)
    sum += static_cast<double>(image.values[i]);
  return sum;
}

void expect_lines(const json& text) {
  EXPECT_EQ(make_plan(scene_of(text), this_machine(1)).integration.value, Integration::lines);
}

/// A sphere in the middle, white by ambient light alone: a disc on the image.
json white_ball(double radius, double distance, int width, int height, double fov) {
  json text = document(camera_json(width, height, fov, {0, 0, -distance}, {}),
                       {sphere_json({}, radius)}, {});
  text["ambient"] = 1;
  text["shadows"] = "ambient";
  return text;
}

/// The disc's radius in pixels is that of the tangent of its half angle. Nine samples in each pixel
/// are off by a hundred times as much.
TEST(Lines, CoverADiscToItsArea) {
  for (const char* precision : {"single", "double"}) {
    const json text = white_ball(1, 5, 60, 44, 0.6);
    expect_lines(with_target(text, 0.01, precision));
    const Image image = image_of(with_target(text, 0.01, precision));
    const double radius = std::tan(std::asin(1.0 / 5)) / std::tan(0.3) * 30;
    EXPECT_NEAR(sum_of(image), pi * radius * radius, 1e-4 * pi * radius * radius) << precision;
  }
}

/// Of a sphere smaller than a pixel, by many lines.
TEST(Lines, CoverASpeckToItsArea) {
  const json text = with_target(white_ball(0.04, 5, 15, 11, 0.6), 0.0001, "double");
  const double radius = std::tan(std::asin(0.04 / 5)) / std::tan(0.3) * 7.5;
  ASSERT_LT(radius, 0.3);
  EXPECT_NEAR(sum_of(image_of(text)), pi * radius * radius, 0.01 * pi * radius * radius);
}

/// Lit from the side, half of the disc is dark: to the left of the terminator, which a sphere far
/// away shows as a straight line, it is as bright as kd times the mean incidence.
TEST(Lines, EndLightAtTheTerminator) {
  json text = white_ball(1, 100000, 60, 44, 0.00003);
  text["ambient"] = 0;
  text["objects"][0]["material"] = {{"color", {1, 1, 1}}, {"ka", 0}, {"kd", 1}, {"ks", 0}};
  text["lights"] = {distant_json({1, 0, 0})};
  expect_lines(with_target(text, 0.0003, "single"));
  const Image image = image_of(with_target(text, 0.0003, "single"));
  const double radius = 0.00001 / std::tan(0.000015) * 30;
  // The incidence at (x, y) on the unit disc is -x: the half disc's integral of it is 2/3.
  EXPECT_NEAR(sum_of(image), 2.0 / 3 * radius * radius, 2e-4 * radius * radius);
}

/// The shadow that a small ball casts towards the eye's side of a large one, with the light along
/// the view: it is the part that is hidden, so nothing dark is seen beside it.
TEST(Lines, ShadowsAreWhereTheLightIsHidden) {
  json text =
      document(camera_json(61, 45, 0.01, {0, 0, -1000}, {}),
               {sphere_json({}, 3), sphere_json({1, 0.5, -5}, 0.8)}, {distant_json({0, 0, 1})});
  text["ambient"] = 0;
  const json shadowed = with_target(text, 0.002, "double");
  text["shadows"] = "off";
  const json lit = with_target(text, 0.002, "double");
  expect_lines(shadowed);
  const Image with_shadows = image_of(shadowed);
  const Image without = image_of(lit);
  ASSERT_GT(sum_of(without), 100);
  EXPECT_NEAR(sum_of(with_shadows), sum_of(without), 0.003 * sum_of(without));
}

}  // namespace
}  // namespace raytracer::test

// The coarsest pictures, of budgets in which hardly anything is traced.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tests/support/rms_difference.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr double no_time_ms = 1e-9;

/// A light sphere that fills a third of the width, before black.
json sphere_before_black(int width, int height) {
  json text = document(camera_json(width, height),
                       {sphere_json({0, 0, 4}, 0.7, constant_material({0.9, 0.6, 0.3}))});
  text["ambient"] = 1;
  text["shadows"] = "ambient";
  return text;
}

Rendering rendering_of(json text, std::optional<double> budget_ms) {
  if (budget_ms) text["render"]["budget_ms"] = *budget_ms;
  WorkerPool pool(2);
  RenderProgress progress;
  return render(scene_of(text), Limits{}, pool, progress);
}

/// A light sheet that fills the image: what is not shown stays black.
TEST(CoarsePicture, shows_something_for_every_block) {
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 3}, {300, 16}, {701, 499}}) {
    json text = document(camera_json(width, height),
                         {plane_json({0, 0, 1}, {0, 0, -1}, constant_material({0.9, 0.6, 0.3}))});
    text["ambient"] = 1;
    text["shadows"] = "ambient";
    const Rendering coarse = rendering_of(text, no_time_ms);
    const auto& values = coarse.image.values;
    EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.29) << width << " x " << height;
  }
}

TEST(CoarsePicture, of_a_large_image_traces_less_than_a_subtile_of_each_block) {
  const Rendering coarse = rendering_of(sphere_before_black(1400, 1000), no_time_ms);
  EXPECT_LT(coarse.samples_per_pixel, 1.0 / 32);
  EXPECT_GT(coarse.samples_per_pixel, 1.0 / 4096);
  EXPECT_EQ(coarse.stop, Stop::budget);
}

TEST(CoarsePicture, of_a_small_image_traces_a_subtile_of_each_block) {
  const Rendering coarse = rendering_of(sphere_before_black(96, 64), no_time_ms);
  EXPECT_EQ(coarse.samples_per_pixel, 1.0 / 16);
}

TEST(CoarsePicture, of_a_tiny_image_traces_every_pixel_and_does_not_call_itself_exact) {
  for (const auto& [width, height] : {std::pair{6, 6}, {16, 12}, {32, 24}}) {
    const Rendering coarse = rendering_of(sphere_before_black(width, height), no_time_ms);
    EXPECT_EQ(coarse.samples_per_pixel, 1);
    EXPECT_GT(coarse.estimated_error, 0.02) << width << " x " << height;
    EXPECT_EQ(coarse.stop, Stop::budget);
  }
}

TEST(CoarsePicture, tells_an_error_near_its_own) {
  const Rendering exact = rendering_of(sphere_before_black(1400, 1000), {});
  const Rendering coarse = rendering_of(sphere_before_black(1400, 1000), no_time_ms);
  const double error = rms_difference(coarse.image, exact.image);
  ASSERT_TRUE(coarse.estimated_error.has_value());
  EXPECT_GT(*coarse.estimated_error, 0.5 * error);
  EXPECT_LT(*coarse.estimated_error, 3 * error);
}

}  // namespace
}  // namespace raytracer::test

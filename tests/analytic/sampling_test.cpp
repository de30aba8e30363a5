// A pixel is the mean of its samples, each clamped before, encoded after.
//
// The one pixel spans [-tw, tw] x [-tw, tw] at distance 1; a bright sheet at distance 1 covers a
// known part of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "tests/analytic/expect_color.h"
#include "tests/support/rms_difference.h"

namespace raytracer::test {
namespace {

const double tw = std::tan(0.5);  // the camera's fov is 1

/// A sheet below the line from (0, left) to (1, right), in shares of the pixel, of brightness i.
json half_covered(double left, double right, double intensity, int samples) {
  const double at_left = (2 * (left + 9 * (left - right)) - 1) * tw;    // at x = -9 pixels
  const double at_right = (2 * (right + 9 * (right - left)) - 1) * tw;  // at x = 10 pixels
  const double x_left = -19 * tw;
  const double x_right = 19 * tw;
  json text = document(
      camera_json(),
      {mesh_json(
          {{x_left, at_left, 1}, {x_right, at_right, 1}, {x_right, -99, 1}, {x_left, -99, 1}},
          {{0, 1, 2}, {0, 2, 3}}, diffuse_material())},
      {distant_json({0, 0, 1}, intensity)});
  text["render"]["samples"] = samples;
  return text;
}

TEST(Pixel, is_clamped_before_it_is_averaged) {
  expect_gray(half_covered(0.5, 0.5, 10, 16), 0.5);
  expect_gray(half_covered(0.25, 0.25, 1e300, 16), 0.25);
}

TEST(Pixel, is_encoded_after_it_is_averaged) {
  json text = half_covered(0.5, 0.5, 1, 16);
  text["render"]["transfer"] = "srgb";
  expect_gray(text, 0.7353569830524495);
}

TEST(Pixel, of_one_sample_is_its_centre) {
  EXPECT_EQ(only_color(half_covered(0.499, 0.499, 1, 1)).x, 0);
  expect_gray(half_covered(0.501, 0.501, 1, 1), 1);
  expect_gray(half_covered(0, 1.01, 1, 1), 1);
  EXPECT_EQ(only_color(half_covered(0, 0.99, 1, 1)).x, 0);
}

/// Sums of many equal singles lose what is below the last digit of the sum: here once 8e-4.
TEST(Pixel, of_many_samples_is_their_mean) {
  const Vec3 color{0.53, 0.8, 0.92};
  json text = document(camera_json(16, 8, 0.6, {0, 0, -5}, {}),
                       {sphere_json({2, 0, 0}, 2, constant_material(color))});
  text["ambient"] = 1;
  text["shadows"] = "ambient";
  text["background"] = {color.x, color.y, color.z};
  text["render"] = {{"samples", 65536}, {"precision", "single"}};
  const Image image = image_of(text);
  for (int x = 0; x < image.width; ++x)
    EXPECT_LT(distance(color_at(image, x, 4), color), 1e-6) << x;
}

TEST(Pixel, on_an_edge_approaches_its_exact_coverage) {
  for (const auto& [left, right] : {std::pair{0.3, 0.4}, {0.1, 0.9}, {0.73, 0.21}, {0.02, 0.07}}) {
    const double coverage = (left + right) / 2;
    EXPECT_NEAR(only_color(half_covered(left, right, 1, 1024)).x, coverage, 0.003);
    EXPECT_NEAR(only_color(half_covered(left, right, 1, 65536)).x, coverage, 2e-4);
  }
}

/// With random samples the root of the mean would be 0.054.
TEST(Pixel, on_an_edge_errs_little_by_few_samples) {
  constexpr int steps = 12;
  double squares = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double left = (i + 0.5) / steps;
      const double right = (j + 0.5) / steps;
      const double error = only_color(half_covered(left, right, 1, 64)).x - (left + right) / 2;
      EXPECT_LT(std::abs(error), 0.06) << left << ", " << right;
      squares += error * error;
    }
  EXPECT_LT(std::sqrt(squares / (steps * steps)), 0.013);
}

TEST(Contract, of_accuracy_ends_at_its_target_or_says_that_it_did_not) {
  json text = half_covered(0.3, 0.4, 1, 1);
  text["render"] = {{"target_rmse", 0.01}};
  const Scene scene = scene_of(text);
  WorkerPool pool(2);
  RenderProgress progress;
  const Rendering rendering = render(scene, Limits{}, pool, progress);
  EXPECT_EQ(rendering.stop, Stop::target);
  ASSERT_TRUE(rendering.estimated_error);
  EXPECT_LE(*rendering.estimated_error, 0.01);
  EXPECT_NEAR(color_at(rendering.image, 0, 0).x, 0.35, 0.02);
  RenderProgress again;
  const Rendering limited = render(scene, Limits{.samples = 2}, pool, again);
  EXPECT_EQ(limited.stop, Stop::samples);
  EXPECT_LE(limited.samples_per_pixel, 2);
}

TEST(Contract, of_time_ends_in_time) {
  json text = half_covered(0.3, 0.4, 1, 1);
  text["render"] = {{"budget_ms", 60}};
  WorkerPool pool(2);
  double shortest_ms = std::numeric_limits<double>::infinity();  // other programs only add to it
  for (int i = 0; i < 3; ++i) {
    RenderProgress progress;
    const Rendering rendering = render(scene_of(text), Limits{}, pool, progress);
    EXPECT_EQ(rendering.stop, Stop::budget);
    EXPECT_GT(rendering.samples_per_pixel, 16);
    EXPECT_NEAR(color_at(rendering.image, 0, 0).x, 0.35, 0.02);
    shortest_ms = std::min(shortest_ms, rendering.trace_ms);
  }
  EXPECT_LE(shortest_ms, 90);
}

Image black(const Image& like) {
  Image image(like.width, like.height);
  std::fill(image.values.begin(), image.values.end(), 0.0F);
  return image;
}

json two_balls_on_a_plane() {
  return document(camera_json(200, 150, 0.9, {0, 3, -9}, {0, 0, 0}),
                  {sphere_json({-1.5, 1, 0}, 1.5), sphere_json({1.5, 0.5, -1}, 1),
                   plane_json({0, -1, 0}, {0, 1, 0})},
                  {distant_json({-1, -2, 1})});
}

TEST(Render, says_its_error) {
  json text = two_balls_on_a_plane();
  WorkerPool pool(2);
  const auto with = [&](int samples) {
    text["render"] = {{"samples", samples}};
    RenderProgress progress;
    return render(scene_of(text), Limits{}, pool, progress);
  };
  const Image exact = with(4096).image;
  for (const int samples : {1, 2, 3, 4, 5, 6, 8, 12, 16, 32, 64}) {
    const Rendering rendering = with(samples);
    const double error = rms_difference(rendering.image, exact);
    ASSERT_TRUE(rendering.estimated_error);
    EXPECT_GT(*rendering.estimated_error, error / 2) << samples;
    EXPECT_LT(*rendering.estimated_error, 2.5 * error) << samples;
  }
}

/// The document with these settings.
Rendering rendered(json text, const json& settings) {
  text["render"] = settings;
  WorkerPool pool(2);
  RenderProgress progress;
  return render(scene_of(text), Limits{}, pool, progress);
}

/// Hidden behind a sphere, it makes no pixel other, but has all of them sampled.
const json hidden_triangle =
    mesh_json({{1.5, 0.5, -1}, {1.6, 0.5, -1}, {1.5, 0.6, -1}}, {{0, 1, 2}});

/// An edge of 0.2 % is an edge.
TEST(Contract, of_little_contrast_sees_it) {
  json text = document(
      camera_json(200, 150, 0.9, {0, 3, -9}, {0, 0, 0}),
      {sphere_json({-1.5, 1, 0}, 1.5, constant_material({0.5, 0.5, 0.5})),
       sphere_json({1.5, 0.5, -1}, 1, constant_material({0.5, 0.5, 0.5})), hidden_triangle});
  text["ambient"] = 1;
  text["shadows"] = "ambient";
  text["background"] = {0.5009, 0.5009, 0.5009};
  const Image exact = rendered(text, {{"samples", 4096}, {"precision", "double"}}).image;
  for (const char* precision : {"single", "double"}) {
    const Rendering rendering = rendered(text, {{"target_rmse", 1e-5}, {"precision", precision}});
    const double error = rms_difference(rendering.image, exact);
    EXPECT_GT(error, 1e-6) << "or there is nothing to see";
    EXPECT_GT(rendering.estimated_error.value_or(0), error / 2) << precision;
    EXPECT_LE(error, 1e-5) << precision;
  }
}

/// A far square's lattice beats with that of the samples: its error was estimated at 0.9 of itself
/// here, and the target missed by a tenth.
TEST(Contract, of_accuracy_is_kept_where_a_lattice_is_finer_than_pixels) {
  json text = json::parse(R"({
    "camera": {"origin": [0, 8, -20], "look_at": [0, -1, 0], "fov": 1, "width": 88, "height": 63},
    "background": [0.53, 0.8, 0.92], "ambient": 0.1, "shadows": "black",
    "lights": [
      {"type": "distant", "direction": [-0.6, -1, 0.7], "intensity": 0.6},
      {"type": "distant", "direction": [0.8, -1, 0.3], "color": [1, 0.9, 0.8], "intensity": 0.4}],
    "materials": {"red": {"color": [0.9, 0.2, 0.2]}, "blue": {"color": [0.2, 0.3, 0.9]},
                  "white": {"color": [0.9, 0.9, 0.9]}},
    "objects": [
      {"type": "sphere", "center": [-2.5, 0, 0], "radius": 2, "material": "red"},
      {"type": "sphere", "center": [2.5, 0, -1], "radius": 2, "material": "blue"},
      {"type": "sphere_square", "center": [0, -3, 0], "radius": 0.028, "n": 250, "axes": "xz",
       "material": "white"}]})");
  const Image exact = rendered(text, {{"samples", 6000}}).image;
  const Rendering rendering = rendered(text, {{"target_rmse", 0.01}});
  EXPECT_EQ(rendering.stop, Stop::target);
  EXPECT_LE(rms_difference(rendering.image, exact), 0.01);
}

/// Stars of hundredths of a pixel. What missing one costs was estimated for the 16 pixels about it,
/// which got as many samples each, and the target was missed by a quarter.
TEST(Contract, of_accuracy_is_kept_where_stars_are_smaller_than_pixels) {
  std::ifstream file(SCENES_DIRECTORY "/earth-and-pebble.json");
  json text = json::parse(file);
  for (const auto& [width, height] : {std::pair{44, 31}, {52, 37}, {61, 43}}) {
    text["camera"]["width"] = width;
    text["camera"]["height"] = height;
    const Image exact = rendered(text, {{"samples", 3001}}).image;
    const Rendering rendering = rendered(text, {{"target_rmse", 0.003}});
    EXPECT_EQ(rendering.stop, Stop::target);
    EXPECT_LE(rms_difference(rendering.image, exact), 0.003) << width << " x " << height;
  }
}

/// Each ray in glass may be two, of which a limit that counted all left no second sample.
TEST(Contract, of_accuracy_is_kept_where_rays_branch_often) {
  json text = two_balls_on_a_plane();
  text["objects"][0]["material"] = {{"transparency", 1}, {"fresnel", true}};
  constexpr int width = 100;
  constexpr int height = 75;
  text["camera"]["width"] = width;
  text["camera"]["height"] = height;
  constexpr int depth = 12;
  constexpr int most = 64;
  text["render"] = {{"target_rmse", 0.01}, {"max_depth", depth}};
  WorkerPool pool(2);
  RenderProgress progress;
  const Limits limits{.work = std::int64_t{width} * height * (1 + depth) * most};
  const Rendering rendering = render(scene_of(text), limits, pool, progress);
  EXPECT_EQ(rendering.stop, Stop::target);
  text["render"] = {{"samples", 1024}, {"max_depth", depth}};
  RenderProgress again;
  const Image exact = render(scene_of(text), Limits{}, pool, again).image;
  EXPECT_LE(rms_difference(rendering.image, exact), 0.01);
}

/// With fewer samples than can be compared there is one estimate for one image, and no target that
/// is said to be reached.
TEST(Contract, of_few_samples_does_not_pretend) {
  json text = two_balls_on_a_plane();
  WorkerPool pool(2);
  for (const int most : {1, 2, 3, 4, 7}) {
    std::optional<double> estimate;
    for (const char* bound : {"target_rmse", "budget_ms"}) {
      text["render"] = {{bound, bound[0] == 't' ? 1e-6 : 1000}};
      RenderProgress progress;
      const Rendering rendering = render(scene_of(text), Limits{.samples = most}, pool, progress);
      EXPECT_EQ(rendering.samples_per_pixel, most < 4 ? 1 : 4);
      EXPECT_EQ(rendering.stop, bound[0] == 't' ? Stop::samples : Stop::budget);
      ASSERT_TRUE(rendering.estimated_error);
      EXPECT_DOUBLE_EQ(*rendering.estimated_error, estimate.value_or(*rendering.estimated_error));
      estimate = rendering.estimated_error;
    }
    text["render"] = {{"target_rmse", 0.5}};
    RenderProgress progress;
    EXPECT_EQ(render(scene_of(text), Limits{.samples = most}, pool, progress).stop,
              most < 4 ? Stop::samples : Stop::target);
  }
}

TEST(Contract, of_no_time_is_a_coarse_picture_and_says_its_error) {
  json text = two_balls_on_a_plane();
  WorkerPool pool(2);
  RenderProgress progress;
  text["render"] = {{"samples", 64}};
  const Image exact = render(scene_of(text), Limits{}, pool, progress).image;
  text["render"] = {{"budget_ms", 1e-9}};
  RenderProgress again;
  const Rendering coarse = render(scene_of(text), Limits{}, pool, again);
  EXPECT_EQ(coarse.stop, Stop::budget);
  EXPECT_NEAR(coarse.samples_per_pixel, 1.0 / 16, 0.01);
  const double error = rms_difference(coarse.image, exact);
  EXPECT_LT(error, rms_difference(exact, black(exact)) / 2) << "blocks show their own colours";
  ASSERT_TRUE(coarse.estimated_error);
  EXPECT_GT(*coarse.estimated_error, error / 2);
  EXPECT_LT(*coarse.estimated_error, 2 * error);
}

TEST(Render, that_is_stopped_says_so) {
  WorkerPool pool(2);
  RenderProgress progress;
  progress.stop = true;
  EXPECT_EQ(render(scene_of(half_covered(0.3, 0.4, 1, 16)), Limits{}, pool, progress).stop,
            Stop::cancelled);
}

TEST(Render, reports_its_progress_up_to_one) {
  json text = half_covered(0.3, 0.4, 1, 4);
  text["camera"]["width"] = 100;
  WorkerPool pool(2);
  RenderProgress progress;
  EXPECT_EQ(progress.fraction, 0);
  const Rendering rendering = render(scene_of(text), Limits{}, pool, progress);
  EXPECT_EQ(progress.fraction, 1);
  EXPECT_EQ(rendering.stop, Stop::samples);
  EXPECT_EQ(rendering.samples_per_pixel, 4);
}

/// Stops the render as soon as its progress says that it is done.
Stop stopped_when_done(const Scene& scene) {
  WorkerPool pool(1);
  RenderProgress progress;
  Rendering rendering;
  std::thread renderer([&] { rendering = render(scene, Limits{}, pool, progress); });
  while (progress.fraction < 1) std::this_thread::yield();
  progress.stop = true;
  renderer.join();
  return rendering.stop;
}

TEST(Render, by_a_contract_is_not_done_before_its_progress_says_so) {
  json text =
      document(camera_json(100, 100), {sphere_json({0, 0, 5}, 1)}, {distant_json({0, 0, 1})});
  for (const auto& [bound, value] :
       {std::pair{"target_rmse", 1e-6}, {"budget_ms", 1e-9}, {"budget_ms", 3.0}}) {
    text["render"] = {{bound, value}};
    EXPECT_NE(stopped_when_done(scene_of(text)), Stop::cancelled)
        << bound << ' ' << value << ": the progress was 1, and there was more to stop";
  }
}

}  // namespace
}  // namespace raytracer::test

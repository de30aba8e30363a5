// Forecasts, as far as a busy machine cannot change them: more work is predicted to take longer,
// and the error is near the one that a render has. How near the times are, the bench shows.
#include "engine/forecast/forecast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/edit.h"
#include "tests/support/rms_difference.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

Prediction prediction_of(const Scene& scene, std::size_t threads = 2,
                         const MachineCosts& costs = {0.01, 1e-7}) {
  WorkerPool pool(threads);
  const RenderProgress progress;
  return forecast(scene, Limits{}, costs, pool, progress).value().prediction;
}

/// Spheres of radius 1 in a row before the eye, under a light.
Scene row_of_spheres(int count) {
  Scene scene;
  scene.camera = {.origin = {0, 0, -20}, .look_at = {}, .fov = 0.8, .width = 320, .height = 240};
  scene.lights = {{DistantLight{{-1, -1, 2}}}};
  scene.materials = {Material{}};
  for (int i = 0; i < count; ++i)
    append(scene.objects, {Sphere{{2.5 * (i - (count - 1) / 2.0), 0, 0}, 1}, 0});
  return scene;
}

/// What tracing is predicted to take, in the best of some attempts: others may be at work.
double least_trace_ms(const Scene& scene) {
  double least_ms = prediction_of(scene).trace_ms;
  for (int i = 0; i < 4; ++i) least_ms = std::min(least_ms, prediction_of(scene).trace_ms);
  return least_ms;
}

TEST(Forecast, more_samples_take_longer_and_err_less) {
  Scene scene = row_of_spheres(5);
  const Prediction one = prediction_of(scene);
  const double one_ms = least_trace_ms(scene);
  scene.render.samples = 64;
  const Prediction many = prediction_of(scene);
  EXPECT_EQ(one.samples, 1);
  EXPECT_EQ(many.samples, 64);
  EXPECT_GT(least_trace_ms(scene), 4 * one_ms);
  EXPECT_LT(many.error, one.error / 4);
  EXPECT_GT(many.error, 0);
}

TEST(Forecast, more_pixels_take_longer) {
  Scene scene = row_of_spheres(5);
  const double small_ms = least_trace_ms(scene);
  scene.camera.width *= 4;
  scene.camera.height *= 4;
  EXPECT_GT(least_trace_ms(scene), 4 * small_ms);
}

TEST(Forecast, predicts_soft_light_that_is_swept) {
  Scene scene = row_of_spheres(2500);
  edit(scene.lights, [](auto& lights) { lights = {{SkyLight{}}}; });
  const Prediction one = prediction_of(scene);
  scene.render.samples = 64;
  const Prediction many = prediction_of(scene);
  EXPECT_GT(one.trace_ms, 0);
  EXPECT_GT(many.trace_ms, 2 * one.trace_ms);
  EXPECT_LT(many.error, one.error);
  EXPECT_GT(many.error, 0);
}

TEST(Forecast, more_threads_take_less_time) {
  Scene scene = row_of_spheres(5);
  scene.render.samples = 256;
  const Prediction one = prediction_of(scene, 1);
  const Prediction four = prediction_of(scene, 4);
  EXPECT_EQ(four.thread_count, 4U);
  EXPECT_LT(four.trace_ms, one.trace_ms);
}

TEST(Forecast, error_is_near_the_measured_one) {
  Scene scene = row_of_spheres(5);
  const Prediction one = prediction_of(scene);
  scene.render.samples = 4;
  const Prediction four = prediction_of(scene);
  const Image image_of_four = image_of(scene);
  scene.render.samples = 1024;
  const Image exact = image_of(scene);
  scene.render.samples = 1;
  const double error_of_one = rms_difference(image_of(scene), exact);
  const double error_of_four = rms_difference(image_of_four, exact);
  EXPECT_GT(one.error, error_of_one / 2);
  EXPECT_LT(one.error, error_of_one * 2);
  EXPECT_GT(four.error, error_of_four / 2);
  EXPECT_LT(four.error, error_of_four * 2);
}

TEST(Forecast, background_has_no_error) {
  const Prediction prediction = prediction_of(row_of_spheres(0));
  EXPECT_EQ(prediction.error, 0);
  EXPECT_GT(prediction.trace_ms, 0);
}

TEST(Forecast, contracts_are_predicted_to_be_kept) {
  Scene scene = row_of_spheres(5);
  scene.render.target_rmse = 0.002;
  const Prediction accurate = prediction_of(scene);
  EXPECT_LE(accurate.error, 0.002);
  EXPECT_GT(accurate.samples, 1);
  scene.render.target_rmse.reset();
  scene.render.budget_ms = 200;
  const Prediction timely = prediction_of(scene);
  EXPECT_LE(timely.trace_ms, 200);
  EXPECT_GT(timely.samples, accurate.samples / 64) << "200 ms are long for so few pixels";
}

TEST(Forecast, budgets_that_are_too_short_for_all_pixels_are_predicted) {
  Scene scene = row_of_spheres(5);
  scene.camera.width = 1600;
  scene.camera.height = 1200;
  scene.render.samples = 1;
  const Prediction once = prediction_of(scene);
  scene.render.samples.reset();
  Prediction before;
  before.samples = 0;
  before.error = infinity;
  for (const double share : {1e-6, 0.1, 2.0, 20.0}) {
    scene.render.budget_ms = share * once.trace_ms;
    const Prediction prediction = prediction_of(scene);
    if (share > 0.01) {
      EXPECT_LE(prediction.trace_ms, *scene.render.budget_ms);
    }
    EXPECT_GT(prediction.samples, before.samples) << share;
    EXPECT_LT(prediction.error, before.error) << share;
    if (share < 0.5) {
      EXPECT_LT(prediction.samples, 1);
    }
    before = prediction;
  }
  EXPECT_GT(before.samples, 1);
}

TEST(Forecast, smallest_image_is_predicted) {
  Scene scene = row_of_spheres(5);
  scene.camera.width = 1;
  scene.camera.height = 1;
  EXPECT_GT(prediction_of(scene).trace_ms, 0);
}

TEST(Forecast, eye_inside_a_sphere_is_predicted) {
  Scene scene = row_of_spheres(1);
  scene.camera.origin = {0, 0, 0};
  scene.camera.look_at = {0, 0, 1};
  EXPECT_GT(prediction_of(scene).trace_ms, 0);
}

TEST(Forecast, threads_that_begin_too_late_do_not_count) {
  const MachineCosts slow_start{.start_ms = 1e9, .byte_ms = 1e-7};
  EXPECT_LT(prediction_of(row_of_spheres(5), 4, slow_start).trace_ms, 1e6)
      << "one thread does it alone";
}

TEST(Forecast, memory_is_paid_for_by_the_bytes_that_are_written) {
  Scene scene = row_of_spheres(5);
  const double values = 3.0 * scene.camera.width * scene.camera.height;
  const MachineCosts slow_memory{.start_ms = 0, .byte_ms = 1};
  // Tracing takes milliseconds of these minutes.
  EXPECT_NEAR(prediction_of(scene, 2, slow_memory).trace_ms, values / 2, 0.01 * values);
  scene.render.target_rmse = 0.5;
  EXPECT_NEAR(prediction_of(scene, 2, slow_memory).trace_ms, 4 * values / 2, 0.04 * values)
      << "contracts are kept in floats";
}

TEST(Forecast, stopped_forecast_is_none) {
  WorkerPool pool(2);
  RenderProgress progress;
  progress.stop = true;
  EXPECT_FALSE(forecast(row_of_spheres(5), Limits{}, {}, pool, progress).has_value());
}

TEST(Forecast, machine_costs_are_positive) {
  WorkerPool pool(2);
  const MachineCosts costs = measure_machine_costs(pool);
  EXPECT_GT(costs.start_ms, 0);
  EXPECT_GT(costs.byte_ms, 0);
  EXPECT_LT(costs.byte_ms, 1e-3 / (3 * sizeof(float))) << "a microsecond a pixel of floats";
}

}  // namespace
}  // namespace raytracer::test

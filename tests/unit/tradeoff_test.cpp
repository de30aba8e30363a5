// Error against time: the figures of hand-made images, the front of hand-made points, and curves
// of scenes whose answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "engine/tradeoff/difference.h"
#include "engine/tradeoff/measure_curve.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

Image gray(int width, int height, float value) {
  Image image(width, height);
  std::fill(image.values.begin(), image.values.end(), value);
  return image;
}

TEST(Difference, of_equal_images_is_nothing) {
  const raytracer::Difference none = difference(gray(4, 3, 0.5F), gray(4, 3, 0.5F));
  EXPECT_EQ(none.rmse, 0);
  EXPECT_EQ(none.max_error, 0);
  EXPECT_EQ(none.off_share, 0);
}

TEST(Difference, is_the_root_of_the_mean_square_the_largest_and_the_share_of_pixels) {
  Image image = gray(2, 2, 0.5F);
  image.pixel(1, 0)[2] = 0.25F;
  image.pixel(0, 1)[0] = 0.75F;
  image.pixel(0, 1)[1] = 1;
  const raytracer::Difference found = difference(image, gray(2, 2, 0.5F));
  EXPECT_DOUBLE_EQ(found.rmse, std::sqrt((2 * 0.0625 + 0.25) / 12));
  EXPECT_DOUBLE_EQ(found.max_error, 0.5);
  EXPECT_DOUBLE_EQ(found.off_share, 0.5) << "two of four pixels";
}

TEST(Difference, pixel_is_off_beyond_one255th) {
  EXPECT_EQ(difference(gray(3, 1, 0.5F + 0.9F / 255), gray(3, 1, 0.5F)).off_share, 0);
  EXPECT_EQ(difference(gray(3, 1, 0.5F + 1.1F / 255), gray(3, 1, 0.5F)).off_share, 1);
}

CurvePoint point(double trace_ms, double rmse, bool changes_picture = false) {
  CurvePoint made;
  made.trace_ms = trace_ms;
  made.error.rmse = rmse;
  made.settings.without_shadows = changes_picture;
  return made;
}

/// For each point '*' if it is marked.
std::string marks(std::vector<CurvePoint> points) {
  mark_pareto(points);
  std::string text;
  for (const CurvePoint& each : points) text += each.pareto ? '*' : '-';
  return text;
}

TEST(Pareto, is_what_nothing_else_beats_in_both) {
  EXPECT_EQ(marks({point(1, 0.4), point(2, 0.2), point(3, 0.3), point(4, 0.1)}), "**-*");
  EXPECT_EQ(marks({point(4, 0.1), point(3, 0.3), point(2, 0.2), point(1, 0.4)}), "*-**");
  EXPECT_EQ(marks({}), "");
}

TEST(Pareto, equals_are_both_on_it) { EXPECT_EQ(marks({point(1, 0.4), point(1, 0.4)}), "**"); }

TEST(Pareto, any_gain_counts) {
  EXPECT_EQ(marks({point(1, 0.1), point(2, 0.0995)}), "**");
  EXPECT_EQ(marks({point(1, 0.1), point(2, 0.1)}), "*-");
}

TEST(Pareto, another_picture_takes_the_mark_from_nobody) {
  EXPECT_EQ(marks({point(1, 0.1, true), point(2, 0.2)}), "**");
  EXPECT_EQ(marks({point(3, 0.3, true), point(2, 0.2)}), "-*");
  EXPECT_EQ(marks({point(2, 0.2, true), point(1, 0.1, true), point(3, 0.05)}), "-**");
}

/// A mirror before a lit sphere: shadows, reflections, edges.
Scene mirror_scene() {
  return scene_of(document(camera_json(24, 16, 0.9, {0, 1, -6}, {0, 0, 0}),
                           {sphere_json({-1, 0, 0}, 1, {{"reflectivity", 0.8}}),
                            sphere_json({1.2, 0, 0}, 1), plane_json({0, -1, 0}, {0, 1, 0})},
                           {distant_json({-1, -1, 2})}));
}

struct Measured {
  Curve curve;
  double progress = 0;
};

Measured measure(const Scene& scene, const Limits& limits = {}) {
  WorkerPool pool(2);
  RenderProgress picture;
  CurveProgress progress(picture);
  return {measure_curve(scene, limits, 2'000, pool, progress).value(), progress.fraction()};
}

TEST(MeasureCurve, more_samples_err_less_in_either_precision) {
  const auto [curve, progress] = measure(mirror_scene());
  EXPECT_EQ(progress, 1);
  EXPECT_EQ(curve.width_px, 24);
  EXPECT_EQ(curve.height_px, 16);
  EXPECT_EQ(curve.thread_count, 2U);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    double last = 1;
    int count = 0;
    for (const CurvePoint& each : curve.points) {
      if (each.settings.precision != precision) continue;
      EXPECT_LT(each.error.rmse, last) << *each.settings.samples;
      EXPECT_GT(each.error.rmse, 2 * curve.reference.estimated_error) << *each.settings.samples;
      EXPECT_EQ(each.samples_per_pixel, *each.settings.samples);
      EXPECT_GT(each.trace_ms, 0);
      last = each.error.rmse;
      ++count;
    }
    EXPECT_GE(count, 3);
  }
}

TEST(MeasureCurve, reference_is_as_near_as_it_says) {
  const Scene scene = mirror_scene();
  const CurveReference described = measure(scene).curve.reference;
  EXPECT_GT(described.estimated_error, 0);
  Scene exact = scene;
  exact.render.precision = Precision::double_precision;
  exact.render.samples = *described.settings.samples;
  const Image reference = image_of(exact);
  exact.render.samples = 65'536;
  EXPECT_LE(difference(reference, image_of(exact)).rmse, described.estimated_error);
}

TEST(MeasureCurve, targets_are_reached_and_kept) {
  int count = 0;
  for (const CurvePoint& each : measure(mirror_scene()).curve.points) {
    if (!each.settings.target_rmse) continue;
    EXPECT_LE(each.error.rmse, *each.settings.target_rmse);
    ASSERT_TRUE(each.estimated_error);
    EXPECT_LE(*each.estimated_error, *each.settings.target_rmse);
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(MeasureCurve, what_is_left_out_changes_the_picture) {
  bool shadows = false;
  bool reflections = false;
  for (const CurvePoint& each : measure(mirror_scene()).curve.points) {
    if (!each.settings.changes_picture()) continue;
    EXPECT_GT(each.error.rmse, 0.02);
    shadows = shadows || each.settings.without_shadows;
    reflections = reflections || each.settings.without_reflections;
  }
  EXPECT_TRUE(shadows);
  EXPECT_TRUE(reflections);
}

TEST(MeasureCurve, nothing_is_left_out_that_is_not_there) {
  Scene scene = mirror_scene();
  scene.shadows = Shadows::off;
  scene.render.max_depth = 0;
  for (const CurvePoint& each : measure(scene).curve.points)
    EXPECT_FALSE(each.settings.changes_picture());
}

TEST(MeasureCurve, documents_own_settings_make_no_difference) {
  Scene scene = mirror_scene();
  Limits limits;
  limits.samples = 100;  // what ends the reference, and not the time
  const Curve plain = measure(scene, limits).curve;
  scene.render.target_rmse = 0.1;
  scene.render.budget_ms = 1;
  scene.render.precision = Precision::single_precision;
  const Curve other = measure(scene, limits).curve;
  EXPECT_EQ(plain.reference.estimated_error, other.reference.estimated_error);
  EXPECT_EQ(plain.points.front().error.rmse, other.points.front().error.rmse);
}

TEST(MeasureCurve, plain_background_needs_one_sample) {
  const Curve curve = measure(scene_of(document(camera_json(8, 8)))).curve;
  EXPECT_EQ(curve.reference.estimated_error, 0);
  for (const CurvePoint& each : curve.points) {
    EXPECT_EQ(each.error.rmse, 0);
    EXPECT_LE(each.settings.samples.value_or(1), 1);
  }
  EXPECT_FALSE(curve.points.empty());
}

TEST(MeasureCurve, keeps_within_the_limits) {
  Limits limits;
  limits.samples = 100;
  EXPECT_EQ(*measure(mirror_scene(), limits).curve.reference.settings.samples, 60);
  limits = {};
  // The least that is allowed; a ray may be reflected five times.
  limits.work = std::int64_t{24} * 16 * 6 * least_curve_samples;
  const Curve least = measure(mirror_scene(), limits).curve;
  double samples = 60 + 15;
  for (const CurvePoint& each : least.points)
    samples += each.samples_per_pixel * static_cast<double>(each.repetitions);
  EXPECT_LE(samples, least_curve_samples);
  EXPECT_GE(least.points.size(), 4U);
}

TEST(MeasureCurve, stopped_one_is_none) {
  WorkerPool pool(2);
  RenderProgress picture;
  CurveProgress progress(picture);
  picture.stop = true;
  EXPECT_FALSE(measure_curve(mirror_scene(), Limits{}, 1'000, pool, progress));
}

TEST(MeasureCurve, progress_never_falls) {
  WorkerPool pool(2);
  RenderProgress picture;
  CurveProgress progress(picture);
  std::atomic<bool> done{false};
  std::thread watcher([&] {
    double last = 0;
    while (!done) {
      const double now = progress.fraction();
      EXPECT_GE(now, last);
      EXPECT_LE(now, 1);
      last = now;
      std::this_thread::yield();
    }
  });
  EXPECT_TRUE(measure_curve(mirror_scene(), Limits{}, 1'000, pool, progress));
  done = true;
  watcher.join();
}

}  // namespace
}  // namespace raytracer::test

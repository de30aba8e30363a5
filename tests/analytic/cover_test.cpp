// What a transparent background leaves: colours, and how much of each pixel is covered.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/image/encode.h"
#include "engine/math/transfer.h"
#include "tests/analytic/expect_color.h"
#include "tests/support/rms_difference.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

json transparent(json text) {
  text["background"] = "transparent";
  text["ambient"] = 1;
  text["shadows"] = "ambient";
  return text;
}

/// One pixel, of which a sheet covers the left half.
json half_covered(const Vec3& color, int samples) {
  json text = transparent(
      document(camera_json(), {mesh_json({{-9, -9, 1}, {0, -9, 1}, {0, 9, 1}, {-9, 9, 1}},
                                         {{0, 1, 2}, {0, 2, 3}}, constant_material(color))}));
  text["render"]["samples"] = samples;
  return text;
}

/// The four bytes of the only pixel of a document, as a file has them.
std::vector<int> bytes_of(const json& text) {
  WorkerPool pool(1);
  const ByteImage bytes = to_bytes(image_of(text), pool);
  return {bytes.values.begin(), bytes.values.end()};
}

TEST(Cover, of_half_a_pixel_is_half) {
  for (const auto& [precision, tolerance] : tolerances)
    for (const int samples : {2, 4, 16, 64, 256}) {
      SCOPED_TRACE(testing::Message() << precision << ", " << samples << " samples");
      json text = half_covered({0.8, 0.4, 1}, samples);
      text["render"]["precision"] = precision;
      const Image image = image_of(text);
      ASSERT_EQ(image.channels, 4);
      ASSERT_EQ(image.values.size(), 4U);
      EXPECT_EQ(image.values[3], 0.5F);
      EXPECT_LE(distance(color_at(image, 0, 0), {0.4, 0.2, 0.5}), tolerance);
      EXPECT_EQ(bytes_of(text), (std::vector{204, 102, 255, 128})) << "not premultiplied";
    }
}

TEST(Cover, takes_no_part_in_the_transfer) {
  json text = half_covered({0.8, 0.4, 1}, 16);
  text["render"]["transfer"] = "srgb";
  const auto level = [](double linear) {
    return static_cast<int>(255 * encode_channel(linear, Transfer::srgb) + 0.5);
  };
  EXPECT_EQ(bytes_of(text), (std::vector{level(0.8), level(0.4), 255, 128}));
}

TEST(Cover, of_nothing_is_none_and_black) {
  EXPECT_EQ(bytes_of(transparent(document())), (std::vector{0, 0, 0, 0}));
}

/// A surface without light of its own that fills the pixel and sends all rays on.
json sending_on(json material) {
  for (const char* const key : {"ka", "kd", "ks"}) material[key] = 0;
  json text = document(camera_json(), {sphere_json({0, 0, 5}, 4, material)});
  text["background"] = {0.2, 0.3, 0.4};
  return text;
}

TEST(Cover, counts_what_the_eye_meets_and_the_rest_sees_black) {
  for (const json& material : {json{{"reflectivity", 1}}, json{{"transparency", 1}}}) {
    SCOPED_TRACE(material);
    const json text = sending_on(material);
    EXPECT_LE(distance(only_color(text), {0.2, 0.3, 0.4}), 1e-5);
    EXPECT_EQ(bytes_of(transparent(text)), (std::vector{0, 0, 0, 255}));
  }
}

/// A ball, seen as a disc of a known area (disc_test.cpp).
json disc(const char* transfer) {
  json text = transparent(document(camera_json(60, 60, std::numbers::pi / 2),
                                   {sphere_json({0, 0, 1}, 0.5, constant_material({1, 1, 1}))}));
  text["render"]["transfer"] = transfer;
  return text;
}

double mean_cover(const Image& image) {
  double sum = 0;
  for (std::size_t i = 3; i < image.values.size(); i += 4)
    sum += static_cast<double>(image.values[i]);
  return sum * 4 / static_cast<double>(image.values.size());
}

const double disc_share = std::numbers::pi * (0.25 / (1 - 0.25)) / 4;

TEST(Cover, of_a_ball_is_its_discs_area) {
  for (const char* const transfer : {"linear", "srgb"}) {
    json text = disc(transfer);
    text["render"]["samples"] = 64;
    const Image image = image_of(text);
    EXPECT_NEAR(mean_cover(image), disc_share, 2e-4);
    for (std::size_t i = 0; i < image.values.size(); ++i)
      ASSERT_NEAR(image.values[i], image.values[i | 3], 1e-6) << "white times its cover";
  }
}

TEST(Cover, is_refined_to_a_target_as_colours_are) {
  for (const char* const transfer : {"linear", "srgb"}) {
    SCOPED_TRACE(transfer);
    json exact = disc(transfer);
    exact["render"]["samples"] = 1024;
    const Image reference = image_of(exact);
    for (const double target : {0.02, 0.004}) {
      json text = disc(transfer);
      text["render"]["target_rmse"] = target;
      WorkerPool pool(2);
      RenderProgress progress;
      const Rendering rendering = render(scene_of(text), Limits{}, pool, progress);
      EXPECT_EQ(rendering.stop, Stop::target);
      ASSERT_EQ(rendering.image.channels, 4);
      EXPECT_LE(rms_difference(rendering.image, reference), target);
      EXPECT_NEAR(mean_cover(rendering.image), disc_share, target);
    }
  }
}

/// A black ball differs from nothing in its cover alone.
TEST(Cover, of_what_is_black_is_refined) {
  json text = disc("linear");
  text["objects"][0]["material"]["color"] = {0, 0, 0};
  json exact = text;
  exact["render"]["samples"] = 1024;
  text["render"]["target_rmse"] = 0.004;
  EXPECT_LE(rms_difference(image_of(text), image_of(exact)), 0.004);
}

TEST(Cover, is_there_however_short_the_time_was) {
  for (const double budget_ms : {1e-6, 20.0}) {
    json text = disc("linear");
    text["render"]["budget_ms"] = budget_ms;
    const Image image = image_of(text);
    ASSERT_EQ(image.channels, 4);
    EXPECT_NEAR(mean_cover(image), disc_share, 0.05);
  }
}

}  // namespace
}  // namespace raytracer::test

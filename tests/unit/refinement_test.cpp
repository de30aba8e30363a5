// Which pixels get more samples, and how many.

#include "engine/sample/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace raytracer::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double usual = 1.5;
constexpr int plenty = 1 << 20;

struct Rough {
  int samples;
  double error2;
};

/// The samples that each of the pixels gets, 0 for those that stay.
std::vector<int> samples_for(const std::vector<Rough>& pixels, const RefinementGoal& goal) {
  std::vector<PixelError> rough(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    rough[i] = {static_cast<std::uint32_t>(i), pixels[i].samples,
                static_cast<float>(pixels[i].error2)};
  std::vector<int> samples(pixels.size(), 0);
  for (const PixelSamples& pixel : choose_samples(rough, goal))
    samples[pixel.pixel] = pixel.samples;
  return samples;
}

std::vector<int> samples_for(const std::vector<Rough>& pixels, double error2) {
  return samples_for(pixels, {error2, infinite, plenty});
}

TEST(NextSamples, are_none_when_the_goal_is_reached) {
  EXPECT_EQ(samples_for({{4, 1}, {4, 2}}, 3), (std::vector<int>{0, 0}));
  EXPECT_TRUE(choose_samples({}, {0, infinite, plenty}).empty());
}

TEST(NextSamples, are_for_the_largest_error_per_sample) {
  const std::vector<int> samples = samples_for({{4, 0.1}, {4, 8}, {64, 8}}, 10);
  EXPECT_EQ(samples[0], 0);
  EXPECT_GE(samples[1], 8);
  EXPECT_EQ(samples[2], 0);
}

TEST(NextSamples, are_for_all_when_nothing_is_allowed) {
  EXPECT_EQ(samples_for({{4, 0.1}, {4, 8}, {64, 1e-30}}, 0), (std::vector<int>{64, 64, 1024}))
      << "sixteen times as many at once";
}

TEST(NextSamples, never_exceed_the_limit) {
  EXPECT_EQ(samples_for({{16, 1}, {4, 0.5}}, {1e-9, infinite, 24}), (std::vector<int>{0, 24}));
}

TEST(NextSamples, reach_the_limit_wherever_it_is) {
  EXPECT_EQ(samples_for({{64, 1}}, {1e-9, infinite, 1000}), std::vector<int>{1000});
  EXPECT_EQ(samples_for({{64, 1}}, {1e-9, infinite, 999}), std::vector<int>{996});
  EXPECT_EQ(samples_for({{64, 1}}, {1e-9, infinite, 100}), std::vector<int>{0});
}

TEST(NextSamples, fill_packets_from16_on) {
  for (int exponent = -60; exponent < 60; ++exponent) {
    const int samples = samples_for({{4, std::pow(1.3, exponent)}}, 1e-3)[0];
    EXPECT_TRUE(samples == 0 || samples % 16 == 0) << samples;
  }
}

std::vector<Rough> many() {
  std::vector<Rough> pixels(1000);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = {4, std::pow(1.02, static_cast<double>(i % 300))};
  return pixels;
}

TEST(NextSamples, are_what_there_is_time_for) {
  for (const double affordable : {1e2, 1e3, 1e4, 5e4}) {
    double sum = 0;
    for (const int samples : samples_for(many(), {0, affordable, plenty})) sum += samples;
    EXPECT_LE(sum, affordable);
    EXPECT_GT(sum, affordable / 2 - 4 * 64) << "pixels alike get theirs together";
  }
  EXPECT_EQ(samples_for(many(), {0, 0, plenty}), std::vector<int>(1000, 0));
}

TEST(NextSamples, reach_the_goal_at_once_if_errors_fall_as_expected) {
  const double goal = 6000;
  const std::vector<Rough> pixels = many();
  const std::vector<int> samples = samples_for(pixels, goal);
  double sum = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    sum += pixels[i].error2 * (samples[i] > 0 ? std::pow(4.0 / samples[i], usual) : 1);
  EXPECT_LE(sum, goal);
  EXPECT_GT(sum, 0.8 * goal) << "more than was asked for";
}

/// The fewest samples for a sum of errors have equal errors per sample in all pixels.
TEST(NextSamples, level_the_errors_per_sample) {
  const std::vector<int> samples = samples_for({{4, 1}, {4, 2}, {4, 4}, {4, 8}}, 0.1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const double ratio = static_cast<double>(samples[i + 1]) / samples[i];
    EXPECT_GE(ratio, 1);
    EXPECT_LE(ratio, 2) << "2^(1 / 2.5), to the next number that is used";
  }
}

TEST(NextSamples, count_what_pixels_have_already) {
  // As much detail in both: that with more samples has less of an error.
  const std::vector<int> samples = samples_for({{4, 1}, {64, 1 / std::pow(16, usual)}}, 0.1);
  EXPECT_GE(samples[0], 32);
  EXPECT_EQ(samples[1], 0);
}

}  // namespace
}  // namespace raytracer::test

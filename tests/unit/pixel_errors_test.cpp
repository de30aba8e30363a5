// What pixels' samples come to as errors.

#include "engine/sample/pixel_errors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/math/block.h"
#include "engine/math/transfer.h"

namespace raytracer::test {
namespace {

constexpr int width = 37;  // no multiple of a block
constexpr int height = 21;
constexpr ErrorMultiplier multiplier{.initial = 1, .least = 0.4};

/// What pixels of this variance err by if they err as edges do: no prior changes that.
constexpr float variance = 0.2F;
constexpr float of_4_samples = variance / 8;

/// The same pixels with 16 samples: what the mean of 4 erred, by this multiplier, was missing in
/// their variance, of which so much was no luck.
constexpr PixelSpread with_16_samples(double multiplier, float share = 1) {
  const auto more = static_cast<float>((1 + multiplier / 8) / (1 + multiplier / 64));
  return {share * more * variance / 64, share * more * variance};
}

/// An image whose pixels all have 4 samples, which tell nothing but in some.
class PixelErrorsTest : public testing::Test {
 protected:
  void tell(int x, int y, double error2, double variance) {
    spreads_.set(spreads_.index(x, y), {static_cast<float>(error2), static_cast<float>(variance)});
  }

  PixelErrors& errors() {
    errors_.spreads() = spreads_;
    errors_.set_all(4);
    errors_.estimate();
    return errors_;
  }

  /// All pixels err alike.
  PixelErrors even_errors(double initial) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) tell(x, y, of_4_samples, variance);
    PixelErrors errors(width, height, {initial, multiplier.least}, shown_, pool_);
    errors.spreads() = spreads_;
    errors.set_all(4);
    errors.estimate();
    return errors;
  }

  WorkerPool pool_{1};
  PixelSpreads spreads_{width, height};
  Image image_{width, height};
  ShownError shown_{image_, Transfer::linear};
  PixelErrors errors_{width, height, multiplier, shown_, pool_};
};

TEST_F(PixelErrorsTest, are_none_where_samples_are_equal) {
  EXPECT_EQ(errors().error2(), 0);
  errors_.for_each_error([](std::size_t pixel, double) { ADD_FAILURE() << pixel; });
}

TEST_F(PixelErrorsTest, are_the_halves_in_all) {
  for (int x = 8; x < 28; ++x) tell(x, 9, of_4_samples, variance);
  double sum = 0;
  errors().for_each_error([&](std::size_t, double error2) { sum += error2; });
  EXPECT_NEAR(sum, 20 * of_4_samples, 0.3 * 20 * of_4_samples)
      << "and a little for what is beside them";
  EXPECT_GT(errors_.error2(), sum) << "for its uncertainty";
}

/// As soon as halves differ by more than edges do, they are believed.
TEST_F(PixelErrorsTest, are_the_halves_of_a_single_pixel_if_they_are_more) {
  tell(12, 9, 0.5 * variance, variance);
  // Of it and the eight beside it, which count a fifth.
  const double of_pixel = 0.5 * variance / (1 + 8 * 0.2);
  EXPECT_NEAR(errors().of_pixel(errors_.index(12, 9)), of_pixel, 0.01 * of_pixel);
}

/// Others are all set, which is no refinement: none of them was chosen for its luck.
TEST_F(PixelErrorsTest, learn_no_luck_of_pixels_that_were_not_chosen) {
  PixelErrors all = even_errors(0.7);
  PixelErrors twice = even_errors(0.7);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      twice.set(twice.index(x, y), 4, {0, 2 * variance});
    }
  twice.estimate();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) twice.set(twice.index(x, y), 4, {of_4_samples, variance});
  twice.estimate();
  std::vector<std::uint32_t> pixels;
  pixels.reserve(width);
  for (int x = 0; x < width; ++x) pixels.push_back(static_cast<std::uint32_t>(all.index(x, 9)));
  for (PixelErrors* const errors : {&all, &twice}) {
    for (const std::uint32_t pixel : pixels) errors->refine(pixel, 16, with_16_samples(0.7, 0.5F));
    errors->learn(0.1);
  }
  EXPECT_EQ(twice.of_pixel(all.index(5, 4)), all.of_pixel(all.index(5, 4)));
  EXPECT_EQ(twice.of_pixel(pixels[5]), all.of_pixel(pixels[5]));
}

/// A glint that 4 samples saw and 16 did not: another, which nobody looked at again, may err more.
TEST_F(PixelErrorsTest, are_more_elsewhere_if_all_that_was_told_was_luck) {
  tell(5, 5, of_4_samples, variance);
  tell(34, 5, of_4_samples, variance);
  const std::size_t left = errors().index(34, 5);
  const double before = errors_.of_pixel(left);
  errors_.refine(errors_.index(5, 5), 16, {});
  errors_.learn(0);
  EXPECT_EQ(errors_.of_pixel(errors_.index(5, 5)), 0);
  EXPECT_GT(errors_.of_pixel(left), 1.2 * before);
}

/// An edge at 45 degrees passes all of its pixels alike: halves that agree there say so once.
TEST_F(PixelErrorsTest, are_there_where_an_edge_splits_all_halves_evenly) {
  for (int i = 4; i < 20; ++i) tell(i, i, 0, variance);
  EXPECT_GT(errors().of_pixel(errors_.index(12, 12)), 0.02 * of_4_samples);
}

TEST_F(PixelErrorsTest, are_next_to_none_where_many_halves_agree) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) tell(x, y, 0, 1e-4);
  EXPECT_LT(errors().of_pixel(errors_.index(12, 12)), 0.02 * 1e-4 / 8);
}

/// One pixel's halves agree by chance: its variance says that it has an error as the others.
TEST_F(PixelErrorsTest, are_shared_by_variance) {
  for (int x = 8; x < 28; ++x) tell(x, 9, x % 2 == 0 ? 0.02 : 0, 0.2);
  tell(15, 9, 0, 0.4);
  const double common = errors().of_pixel(errors_.index(16, 9));
  EXPECT_GT(common, 0);
  EXPECT_DOUBLE_EQ(errors_.of_pixel(errors_.index(17, 9)), common);
  EXPECT_NEAR(errors_.of_pixel(errors_.index(15, 9)), 2 * common, 0.2 * common);
}

TEST_F(PixelErrorsTest, rise_beside_detail) {
  tell(15, 9, 0.01, 0.2);
  const double detailed = errors().of_pixel(errors_.index(15, 9));
  EXPECT_NEAR(errors_.of_pixel(errors_.index(16, 10)), detailed / 5, detailed / 50)
      << "in the subtile and block beside it";
  EXPECT_GT(errors_.of_pixel(errors_.index(18, 9)), 0);
  EXPECT_EQ(errors_.of_pixel(errors_.index(30, 9)), 0);
}

TEST_F(PixelErrorsTest, end_where_more_samples_are_equal) {
  tell(15, 9, 0.01, 0.2);
  const std::size_t pixel = errors().index(15, 9);
  EXPECT_GT(errors_.of_pixel(errors_.index(16, 9)), 0);
  errors_.set(pixel, 64, {});
  errors_.estimate();
  EXPECT_EQ(errors_.error2(), 0);
  EXPECT_EQ(errors_.of_pixel(errors_.index(16, 9)), 0);
}

TEST_F(PixelErrorsTest, are_less_with_more_samples) {
  for (int x = 8; x < 28; ++x) tell(x, 9, 0.01, 0.2);
  const std::size_t pixel = errors().index(16, 9);
  const double before = errors_.of_pixel(pixel);
  errors_.set(pixel, 64, {static_cast<float>(0.01 / 64), 0.2F});
  errors_.estimate();
  EXPECT_EQ(errors_.samples(pixel), 64);
  EXPECT_NEAR(errors_.of_pixel(pixel), before / 64, 0.3 * before / 64);
  EXPECT_EQ(errors_.sample_count(), 4 * width * height + 60);
}

TEST_F(PixelErrorsTest, are_none_beyond_the_rim) {
  for (int y = 0; y < height; ++y) tell(width - 1, y, 0.01, 0.2);
  for (int x = 0; x < width; ++x) tell(x, height - 1, 0.01, 0.2);
  int count = 0;
  errors().for_each_error([&](std::size_t pixel, double error2) {
    ++count;
    EXPECT_LT(errors_.x_of(pixel), width);
    EXPECT_LT(errors_.y_of(pixel), height);
    EXPECT_TRUE(std::isfinite(error2));
  });
  EXPECT_GE(count, width + height - 1);
}

TEST_F(PixelErrorsTest, of_those_that_a_refinement_leaves_are_more_if_the_others_had_luck) {
  constexpr float luck = 0.8F;  // of what their variance told a fifth was
  const auto error_left = [&](float lasting) {
    PixelErrors errors = even_errors(0.7);
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 12; x < width; ++x)
        pixels.push_back(static_cast<std::uint32_t>(errors.index(x, y)));
    for (const std::uint32_t pixel : pixels)
      errors.refine(pixel, 16, with_16_samples(0.7, lasting));
    const double of_16_samples = static_cast<double>(with_16_samples(0.7, lasting).error2);
    const double change = lasting * of_4_samples + of_16_samples;
    errors.learn(0.7 * change * static_cast<double>(pixels.size()));
    EXPECT_NEAR(errors.of_pixel(errors.index(20, 9)), 0.7 * of_16_samples, 1e-5);
    return errors.of_pixel(errors.index(5, 9));
  };
  EXPECT_NEAR(error_left(1), 0.7 * of_4_samples, 2e-4);
  EXPECT_NEAR(error_left(luck), 0.7 * of_4_samples * (1 + 0.2 * 25 / 12), 2e-3);
}

TEST_F(PixelErrorsTest, are_corrected_alike_by_each_of_several_refinements) {
  PixelErrors errors = even_errors(0.7);
  // What they change is what they err by the multiplier that there is.
  const double of_16_samples = static_cast<double>(with_16_samples(0.7).error2);
  for (const int x_begin : {0, width / 3, 2 * width / 3}) {
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < height; ++y)
      for (int x = x_begin; x < x_begin + width / 3; ++x)
        pixels.push_back(static_cast<std::uint32_t>(errors.index(x, y)));
    for (const std::uint32_t pixel : pixels) errors.refine(pixel, 16, with_16_samples(0.7));
    errors.learn(static_cast<double>(pixels.size()) * 0.7 * (of_4_samples + of_16_samples));
    EXPECT_NEAR(errors.of_pixel(pixels.front()), 0.7 * of_16_samples, 0.05 * of_16_samples)
        << x_begin;
  }
}

TEST_F(PixelErrorsTest, are_what_a_refinement_changed) {
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      tell(x, y, of_4_samples, variance);
      pixels.push_back(static_cast<std::uint32_t>(spreads_.index(x, y)));
    }
  const auto refined_with_change = [&](double share, double least = multiplier.least) {
    PixelErrors refined(width, height, {multiplier.initial, least}, shown_, pool_);
    refined.spreads() = spreads_;
    refined.set_all(4);
    refined.estimate();
    const double expected_before = refined.of_pixel(pixels[0]);
    EXPECT_NEAR(expected_before, of_4_samples, 1e-4);
    PixelErrors alike = refined;
    for (const std::uint32_t pixel : pixels) {
      alike.set(pixel, 16, with_16_samples(multiplier.initial));
      refined.refine(pixel, 16, with_16_samples(multiplier.initial));
    }
    alike.estimate();
    const double uncorrected = alike.of_pixel(pixels[0]);
    const double count = static_cast<double>(pixels.size());
    refined.learn(share * count * (of_4_samples + uncorrected));
    return refined.of_pixel(pixels[0]) / uncorrected;
  };
  EXPECT_NEAR(refined_with_change(1), 1, 0.01);
  EXPECT_NEAR(refined_with_change(2), 1.9, 0.1) << "as far as so many pixels are believed";
  EXPECT_NEAR(refined_with_change(0.8), 0.8, 0.05);
  EXPECT_NEAR(refined_with_change(0), 0.4, 1e-6) << "less is not believed";
  EXPECT_NEAR(refined_with_change(0, 0.85), 0.85, 1e-6) << "nor here";
  EXPECT_DOUBLE_EQ(refined_with_change(1000), 4);
}

/// At the rim subtiles have fewer pixels, and fewer beside them: what is beside counts as much.
TEST_F(PixelErrorsTest, rise_beside_detail_at_a_rim) {
  PixelErrors thin(64, 1, multiplier, shown_, pool_);
  const std::size_t detailed = thin.index(17, 0);
  thin.spreads().set(detailed, {0.01F, 0.2F});
  thin.set_all(4);
  thin.estimate();
  // Itself and two beside it, which count a fifth, are of its subtile; the subtiles beside have 8
  // pixels.
  const double subtile = thin.of_pixel(detailed) * (1 + 2 * 0.2);
  EXPECT_NEAR(thin.of_pixel(thin.index(21, 0)), 0.1 * subtile / 8, 0.1 * 0.1 * subtile / 8);
}

TEST_F(PixelErrorsTest, are_guessed_until_samples_tell) {
  errors_.set_all(1);
  errors_.set_guess(0, 0.5);
  errors_.set_guess(subtiles_in_block, 0.25);
  errors_.set_guess(1, std::numeric_limits<double>::quiet_NaN());
  errors_.use_guesses();
  EXPECT_DOUBLE_EQ(errors_.expected_error2(), 0.75);
  EXPECT_EQ(errors_.sample_count(), width * height);
  errors_.forget_guesses(0);
  errors_.set(errors_.index(2, 2), 4, {0.01F, 0.2F});
  errors_.estimate();
  EXPECT_EQ(errors_.of_subtile(subtiles_in_block), 0.25);
  EXPECT_GT(errors_.of_subtile(0), 0.01);
  EXPECT_LT(errors_.of_subtile(0), 0.1);
}

/// sRGB of 0.002 is 0.026, of 0.25 it is 0.54: the same deviation shows ten times as far near
/// black.
TEST(ShownError, is_that_of_linear_light_through_the_slope_of_the_transfer) {
  Image image(3, 1);
  const std::array<double, 3> linear{0, 0.002, 0.25};
  for (int x = 0; x < 3; ++x)
    for (int channel = 0; channel < 3; ++channel)
      image.pixel(x, 0)[channel] =
          static_cast<float>(encode_channel(linear[static_cast<std::size_t>(x)], Transfer::srgb));
  const double deviation = 1e-3;
  const double error2 = 3 * deviation * deviation;
  EXPECT_EQ(ShownError(image, Transfer::linear)(error2, 2, 0), error2);
  const ShownError shown(image, Transfer::srgb);
  EXPECT_EQ(shown(0, 1, 0), 0);
  EXPECT_NEAR(std::sqrt(shown(error2, 1, 0) / error2), 12.92, 0.6) << "the straight part";
  const double slope = 1.055 / 2.4 * std::pow(0.25, 1 / 2.4 - 1);
  EXPECT_NEAR(std::sqrt(shown(error2, 2, 0) / error2), slope, 0.02 * slope);
  EXPECT_NEAR(std::sqrt(shown(error2, 0, 0) / error2), 12.92 / std::sqrt(2), 0.3)
      << "black has one side";
}

/// Two ways of counting take turns as a deviation grows: where they meet nothing jumps.
TEST(ShownError, grows_steadily_with_the_deviation) {
  Image image(1, 1);
  const ShownError shown(image, Transfer::srgb);
  for (const double linear : {0.001, 0.003, 0.0042, 0.02, 0.2, 0.7}) {
    for (int channel = 0; channel < 3; ++channel)
      image.pixel(0, 0)[channel] = static_cast<float>(encode_channel(linear, Transfer::srgb));
    double before = 0;
    for (int step = 0; step < 1600; ++step) {  // from 0.05 to 0.25 of it
      const double deviation = 0.05 * linear * std::pow(1.001, step);
      const double here = shown(3 * deviation * deviation, 0, 0) / (deviation * deviation);
      if (before > 0) {
        EXPECT_NEAR(here / before, 1, 0.003) << deviation << " of " << linear;
      }
      before = here;
    }
  }
}

}  // namespace
}  // namespace raytracer::test

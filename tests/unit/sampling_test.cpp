// Where samples lie, and how many a contract takes.

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "engine/sample/contract.h"
#include "engine/sample/pattern.h"

namespace raytracer::test {
namespace {

TEST(SamplePattern, OfOneIsTheCentre) {
  const std::vector<SamplePoint> points = sample_pattern(1);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].x, 0.5);
  EXPECT_EQ(points[0].y, 0.5);
}

TEST(SamplePattern, HasOnePointInEveryColumnAndRowInsideThePixel) {
  for (const int count : {2, 3, 4, 5, 7, 8, 9, 16, 17, 31, 64, 100, 256, 1000, 4096, 65536}) {
    const std::vector<SamplePoint> points = sample_pattern(count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    std::set<int> columns;
    std::set<int> rows;
    for (const SamplePoint& point : points) {
      EXPECT_GE(point.x, 0);
      EXPECT_LT(point.x, 1);
      EXPECT_GE(point.y, 0);
      EXPECT_LT(point.y, 1);
      columns.insert(static_cast<int>(point.x * count));
      rows.insert(static_cast<int>(point.y * count));
    }
    EXPECT_EQ(columns.size(), points.size());
    EXPECT_EQ(rows.size(), points.size());
  }
}

TEST(SamplePattern, CoversTheQuartersOfThePixelEvenly) {
  for (const int count : {16, 64, 256, 1000}) {
    int lower_left = 0;
    for (const SamplePoint& point : sample_pattern(count))
      if (point.x < 0.5 && point.y < 0.5) ++lower_left;
    EXPECT_NEAR(lower_left, count / 4.0, 2 + count * 0.02);
  }
}

RenderSettings settings(std::optional<double> target, std::optional<double> budget_ms) {
  RenderSettings result;
  result.target_rmse = target;
  result.budget_ms = budget_ms;
  return result;
}

constexpr int plenty = 1 << 20;

TEST(NextPass, EndsWhenTheTargetIsMet) {
  EXPECT_FALSE(next_pass(settings(0.01, {}), {4, 1, 5, 0.01}, plenty));
  EXPECT_FALSE(next_pass(settings(0.01, {}), {4, 1, 5, 0.001}, plenty));
  EXPECT_FALSE(next_pass(settings(0.01, 1000), {4, 1, 5, 0.001}, plenty));
}

TEST(NextPass, TakesMoreSamplesWhileTheTargetIsMissedOrNotYetKnown) {
  const auto after_first = next_pass(settings(0.01, {}), {first_pass_samples, 1, 1, {}}, plenty);
  ASSERT_TRUE(after_first);
  EXPECT_GT(*after_first, first_pass_samples);
  const auto later = next_pass(settings(0.01, {}), {16, 1, 5, 0.02}, plenty);
  ASSERT_TRUE(later);
  EXPECT_GE(*later, 32);
}

TEST(NextPass, NeverTakesMoreThanTheLimit) {
  const auto next = next_pass(settings(1e-9, {}), {16, 1, 5, 0.5}, 40);
  ASSERT_TRUE(next);
  EXPECT_EQ(*next, 40);
  EXPECT_FALSE(next_pass(settings(1e-9, {}), {40, 1, 5, 0.5}, 40));
}

TEST(NextPass, EndsWhenTheTimeIsOver) {
  EXPECT_FALSE(next_pass(settings({}, 100), {4, 50, 100, 0.5}, plenty));
  EXPECT_FALSE(next_pass(settings({}, 100), {4, 50, 150, 0.5}, plenty));
  EXPECT_FALSE(next_pass(settings({}, 100), {4, 50, 60, 0.5}, plenty));  // 40 ms: not even twice
}

TEST(NextPass, TakesNoMoreThanTheTimeThatIsLeftAllows) {
  const auto next = next_pass(settings({}, 100), {10, 10, 70, 0.5}, plenty);
  ASSERT_TRUE(next);
  EXPECT_GE(*next, 20);
  EXPECT_LE(*next, 30);
}

TEST(NextPass, SurvivesAPassThatTookNoTime) {
  const auto next = next_pass(settings({}, 100), {1, 0, 0, {}}, plenty);
  ASSERT_TRUE(next);
  EXPECT_GT(*next, 1);
  EXPECT_FALSE(next_pass(settings({}, 100), {1, 0, 200, {}}, plenty));
}

Image gray(float value) {
  Image image(4, 3);
  for (float& channel : image.values) channel = value;
  return image;
}

TEST(EstimateError, OfEqualImagesIsZero) {
  EXPECT_EQ(estimate_error(gray(0.5F), gray(0.5F), 4), 0);
}

TEST(EstimateError, IsTheDifferenceOverTheRootOfTheRatioLessOne) {
  EXPECT_DOUBLE_EQ(estimate_error(gray(0.5F), gray(0.75F), 4), 0.25);
  EXPECT_DOUBLE_EQ(estimate_error(gray(0.75F), gray(0.5F), 9), 0.125);
}

TEST(EstimateError, IsTheRootOfTheMeanSquare) {
  Image later = gray(0.5F);
  later.pixel(0, 0)[1] = 1;
  EXPECT_NEAR(estimate_error(gray(0.5F), later, 4), std::sqrt(0.25 / 36), 1e-12);
}

}  // namespace
}  // namespace raytracer::test

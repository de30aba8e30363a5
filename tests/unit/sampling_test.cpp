// Where samples lie, and how many a contract takes.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"

namespace raytracer::test {
namespace {

TEST(SamplePattern, OfOneIsTheCentre) {
  const std::vector<SamplePoint> points = sample_pattern(1).points;
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].x, 0.5);
  EXPECT_EQ(points[0].y, 0.5);
}

TEST(SamplePattern, HasOnePointInEveryColumnAndRowInsideThePixel) {
  for (const int count : {2, 3, 4, 5, 7, 8, 9, 16, 17, 31, 64, 100, 256, 1000, 4096, 65536}) {
    const std::vector<SamplePoint> points = sample_pattern(count).points;
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
    for (const SamplePoint& point : sample_pattern(count).points)
      if (point.x < 0.5 && point.y < 0.5) ++lower_left;
    EXPECT_NEAR(lower_left, count / 4.0, 2 + count * 0.02);
  }
}

TEST(SamplePattern, StaggeredMovesEachPixelsPlacesWithinTheirColumnsAndRows) {
  const SamplePattern pattern = staggered_pattern(16);
  EXPECT_EQ(pattern.points.size(), 16U);
  std::set<double> across;
  std::set<double> up;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const SamplePoint moved = stagger_of(x, y);
      EXPECT_LT(std::abs(moved.x) * pattern.stagger, 0.5 / 16);
      EXPECT_LT(std::abs(moved.y) * pattern.stagger, 0.5 / 16);
      across.insert(moved.x);
      up.insert(moved.y);
    }
  EXPECT_EQ(across.size(), 16U);
  EXPECT_EQ(up.size(), 16U);
}

/// Along a row of four the places differ by a quarter in y, and along a column in x: that is what
/// finds an edge that runs along it.
TEST(SamplePattern, NeighboursAreStaggeredAcrossTheirRowOrColumn) {
  for (int k = 0; k < 4; ++k) {
    std::set<int> quarters_of_row;
    std::set<int> quarters_of_column;
    for (int i = 0; i < 4; ++i) {
      quarters_of_row.insert(static_cast<int>((stagger_of(i, k).y + 0.5) * 4));
      quarters_of_column.insert(static_cast<int>((stagger_of(k, i).x + 0.5) * 4));
    }
    EXPECT_EQ(quarters_of_row.size(), 4U);
    EXPECT_EQ(quarters_of_column.size(), 4U);
  }
}

Image gray(float value) {
  Image image(4, 4);
  for (float& channel : image.values) channel = value;
  return image;
}

const Tile whole_part{0, 0, 4, 4};

TEST(EstimateError, OfEqualImagesIsZero) {
  EXPECT_EQ(estimate_error2(gray(0.5F), gray(0.5F), whole_part, 16), 0);
}

TEST(EstimateError, IsAQuarterOfTheSquaredDifference) {
  EXPECT_DOUBLE_EQ(estimate_error2(gray(0.5F), gray(0.75F), whole_part, 16), 48 * 0.0625 / 4);
  EXPECT_DOUBLE_EQ(estimate_error2(gray(0.75F), gray(0.5F), {0, 0, 2, 1}, 16), 6 * 0.0625 / 4);
}

TEST(EstimateError, IsLargerAfterTheFirstSample) {
  EXPECT_GT(estimate_error2(gray(0.5F), gray(0.75F), whole_part, 4),
            estimate_error2(gray(0.5F), gray(0.75F), whole_part, 16));
}

constexpr int plenty = 1 << 20;

TEST(PartsToRefine, AreNoneWhenTheBoundIsKept) {
  EXPECT_TRUE(parts_to_refine(std::vector<ImagePart>{{4, 1}, {4, 2}}, 3, plenty).empty());
  EXPECT_TRUE(parts_to_refine(std::vector<ImagePart>{{4, 0}}, 0, plenty).empty());
}

TEST(PartsToRefine, AreThoseWithTheLargestErrorPerSample) {
  const std::vector<ImagePart> parts{{4, 0.1}, {4, 8}, {64, 8}, {4, 0}};
  EXPECT_EQ(parts_to_refine(parts, 10, plenty), std::vector<std::size_t>{1});
}

TEST(PartsToRefine, AreAllWithAnErrorWhenNothingIsAllowed) {
  const std::vector<ImagePart> parts{{4, 0.1}, {4, 8}, {64, 1e-30}, {4, 0}};
  EXPECT_EQ(parts_to_refine(parts, 0, plenty), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(PartsToRefine, NeverGetMoreThanTheLimit) {
  const std::vector<ImagePart> parts{{16, 1}, {4, 0.5}};
  EXPECT_EQ(parts_to_refine(parts, 1e-9, 32), std::vector<std::size_t>{1});
}

TEST(PartsToRefine, LeadToTheBoundIfErrorsFallAsExpected) {
  std::vector<ImagePart> parts(1000, ImagePart{4, 0});
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].error2 = std::pow(1.02, static_cast<double>(i % 300));
  double sum = 0;
  int rounds = 0;
  for (;; ++rounds) {
    sum = 0;
    for (const ImagePart& part : parts) sum += part.error2;
    const std::vector<std::size_t> chosen = parts_to_refine(parts, 500, plenty);
    if (chosen.empty()) break;
    for (const std::size_t i : chosen) parts[i] = {growth * parts[i].samples, parts[i].error2 / 8};
  }
  EXPECT_LE(sum, 500);
  EXPECT_GT(sum, 500 / 8.0) << "more than was asked for";
  EXPECT_LE(rounds, 6);
}

/// Two blocks side by side: 8 x 4 parts.
TEST(ExpectedErrors, RiseBesideDetail) {
  std::vector<ImagePart> parts(32, ImagePart{4, 0});
  parts[3] = {16, 1};  // at (3, 0), at the second block's side
  const std::vector<ImagePart> expected = expected_errors(parts, 2);
  EXPECT_EQ(expected[3].error2, 1);
  EXPECT_GT(expected[16].error2, 0);     // at (4, 0)
  EXPECT_GT(expected[2 + 4].error2, 0);  // at (2, 1)
  EXPECT_EQ(expected[1].error2, 0);
  EXPECT_LT(expected[16].error2, 0.5);
}

}  // namespace
}  // namespace raytracer::test

// Where samples lie, how many a contract takes first, and errors that samples do not tell.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "engine/image/pixel_spreads.h"
#include "engine/math/block.h"
#include "engine/sample/neighbour_error.h"
#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"
#include "engine/sample/subpixel_objects.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

TEST(SamplePattern, of_one_is_the_centre) {
  const std::vector<SamplePoint> points = sample_pattern(1).points;
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].x, 0.5);
  EXPECT_EQ(points[0].y, 0.5);
}

TEST(SamplePattern, has_one_point_in_every_column_and_row_inside_the_pixel) {
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

TEST(SamplePattern, covers_the_quarters_of_the_pixel_evenly) {
  for (const int count : {16, 64, 256, 1000}) {
    int lower_left = 0;
    for (const SamplePoint& point : sample_pattern(count).points)
      if (point.x < 0.5 && point.y < 0.5) ++lower_left;
    EXPECT_NEAR(lower_left, count / 4.0, 2 + count * 0.02);
  }
}

SamplePoint middle_of(const std::vector<SamplePoint>& points, std::size_t begin, std::size_t end) {
  SamplePoint sum{0, 0};
  for (std::size_t i = begin; i < end; ++i) {
    sum.x += points[i].x / static_cast<double>(end - begin);
    sum.y += points[i].y / static_cast<double>(end - begin);
  }
  return sum;
}

TEST(SamplePattern, has_half_buffers_about_the_same_middle) {
  for (const int count : {4, 8, 12, 16, 24, 64, 96, 256, 1024}) {
    const SamplePattern pattern = sample_pattern(count);
    ASSERT_TRUE(pattern.has_half_buffers());
    EXPECT_EQ(pattern.half_a_count, pattern.points.size() / 2);
    const SamplePoint first = middle_of(pattern.points, 0, pattern.half_a_count);
    const SamplePoint second =
        middle_of(pattern.points, pattern.half_a_count, pattern.points.size());
    EXPECT_NEAR(first.x, 0.5, 1e-12) << count;
    EXPECT_NEAR(first.y, 0.5, 1e-12) << count;
    EXPECT_NEAR(second.x, 0.5, 1e-12) << count;
    EXPECT_NEAR(second.y, 0.5, 1e-12) << count;
  }
}

TEST(SamplePattern, has_half_buffers_only_where_they_can_be_alike) {
  for (const int count : {1, 2, 3, 5, 6, 7, 9, 17, 31})
    EXPECT_FALSE(sample_pattern(count).has_half_buffers()) << count;
}

TEST(SamplePattern, jittered_moves_each_pixels_places_within_their_columns_and_rows) {
  const SamplePattern pattern = jittered_pattern(16);
  EXPECT_EQ(pattern.points.size(), 16U);
  std::set<double> across;
  std::set<double> up;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const SamplePoint moved = jitter_of(x, y);
      EXPECT_LT(std::abs(moved.x) * pattern.jitter, 0.5 / 16);
      EXPECT_LT(std::abs(moved.y) * pattern.jitter, 0.5 / 16);
      across.insert(moved.x);
      up.insert(moved.y);
    }
  EXPECT_EQ(across.size(), 256U);
  EXPECT_EQ(up.size(), 256U);
}

/// A slope is no error: in no pixel are the places of a half moved, all together.
TEST(SamplePattern, jittered_keeps_the_middle_of_both_halves) {
  for (const int count : {4, 8, 16, 64}) {
    const SamplePattern pattern = jittered_pattern(count);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        std::vector<SamplePoint> points;
        for (const SamplePoint& point : pattern.points)
          points.push_back(sample_in(x, y, point, pattern.jitter));
        for (const auto& [begin, end] : {std::pair(std::size_t{0}, pattern.half_a_count),
                                         {pattern.half_a_count, points.size()}}) {
          const SamplePoint middle = middle_of(points, begin, end);
          EXPECT_NEAR(middle.x, 0.5, 1e-12);
          EXPECT_NEAR(middle.y, 0.5, 1e-12);
        }
      }
  }
}

/// In every pixel each of as many columns and rows as there are places has one.
TEST(SamplePattern, jittered_is_spread_evenly_in_every_pixel) {
  for (const int count : {4, 16, 64}) {
    const SamplePattern pattern = jittered_pattern(count);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        std::set<int> columns;
        std::set<int> rows;
        for (const SamplePoint& point : pattern.points) {
          const SamplePoint at = sample_in(x, y, point, pattern.jitter);
          columns.insert(static_cast<int>(at.x * count));
          rows.insert(static_cast<int>(at.y * count));
        }
        EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
      }
  }
}

/// The parts, so many of equal size, that values from -1/2 to 1/2 fall into.
std::size_t count_parts(int parts, const std::vector<double>& values) {
  std::set<int> met;
  for (const double value : values) met.insert(static_cast<int>((value + 0.5) * parts));
  return met.size();
}

/// Along a row the places differ in y, and along a column in x: that is what finds an edge that
/// runs along it.
TEST(SamplePattern, neighbours_are_jittered_across_their_row_or_column) {
  for (int k = 0; k < 16; ++k)
    for (const int count : {4, 16})
      for (int first = 0; first < 16; first += count) {
        std::vector<double> of_row;
        std::vector<double> of_column;
        for (int i = first; i < first + count; ++i) {
          of_row.push_back(jitter_of(i, k).y);
          of_column.push_back(jitter_of(k, i).x);
        }
        EXPECT_EQ(count_parts(count, of_row), static_cast<std::size_t>(count));
        EXPECT_EQ(count_parts(count, of_column), static_cast<std::size_t>(count));
      }
}

/// The largest gap that values leave between -1/2 and 1/2.
double largest_gap(std::vector<double> values) {
  values.insert(values.end(), {-0.5, 0.5});
  std::sort(values.begin(), values.end());
  double largest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] > -0.5 && values[i - 1] < 0.5)
      largest = std::max(largest, std::min(values[i], 0.5) - std::max(values[i - 1], -0.5));
  return largest;
}

/// Places that moved alike along a diagonal would not find an edge along it.
TEST(SamplePattern, diagonal_neighbours_are_jittered_across_their_diagonal) {
  for (const int slope : {1, -1})
    for (int begin = 0; begin < 16; ++begin) {
      std::vector<double> sums;
      std::vector<double> differences;
      for (int i = 0; i < 16; ++i) {
        const SamplePoint moved = jitter_of(i, begin + slope * i + 16);
        sums.push_back(moved.x + moved.y);
        differences.push_back(moved.x - moved.y);
      }
      EXPECT_LT(largest_gap(sums), 1.0 / 3) << slope << ' ' << begin;
      EXPECT_LT(largest_gap(differences), 1.0 / 3) << slope << ' ' << begin;
    }
}

SceneStatistics statistics_with(double subpixel) {
  SceneStatistics statistics;
  statistics.all.subpixel = subpixel;
  return statistics;
}

TEST(RefinedRmse, is_less_where_a_square_is_far) {
  SceneStatistics statistics = statistics_with(1);
  RenderSettings settings;
  EXPECT_FALSE(refined_rmse(settings, statistics));
  settings.target_rmse = 0.01;
  EXPECT_EQ(refined_rmse(settings, statistics), 0.01);
  statistics.all.has_subpixel_lattice = true;
  EXPECT_DOUBLE_EQ(*refined_rmse(settings, statistics), 0.0077);
  EXPECT_NE(choose_sampling(settings, statistics).reason().find("at most 0.0077"),
            std::string::npos);
}

TEST(ChoosePilotSamples, are_what_the_limit_allows) {
  const SceneStatistics large = statistics_with(0);
  const SceneStatistics small = statistics_with(1);
  EXPECT_EQ(choose_pilot_samples(large, 1000), 4);
  EXPECT_EQ(choose_pilot_samples(small, 1000), 16);
  EXPECT_EQ(choose_pilot_samples(small, 16), 16);
  for (const int most : {4, 5, 15}) {
    EXPECT_EQ(choose_pilot_samples(large, most), 4);
    EXPECT_EQ(choose_pilot_samples(small, most), 4);
  }
  for (const int most : {1, 2, 3}) EXPECT_EQ(choose_pilot_samples(large, most), 1);
}

Image with_edge(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int i = 0; i < 3; ++i) image.pixel(x, y)[i] = x < width / 2 ? 0.0F : 1.0F;
  return image;
}

TEST(NeighbourError, is_that_of_an_edge) {
  const Image image = with_edge(8, 6);
  EXPECT_DOUBLE_EQ(neighbour_error2(image, {0, 0, 8, 6}), 3 * 6 / 8.0);
  EXPECT_DOUBLE_EQ(neighbour_error(image, 1), std::sqrt(1 / 64.0));
  EXPECT_DOUBLE_EQ(neighbour_error(image, 4), std::sqrt(1 / 64.0 / 8));
  ByteImage bytes(8, 6);
  for (std::size_t i = 0; i < image.values.size(); ++i) bytes.values[i] = to_byte(image.values[i]);
  EXPECT_DOUBLE_EQ(neighbour_error(bytes, 1), neighbour_error(image, 1));
}

TEST(NeighbourError, counts_what_is_beside_a_tile) {
  const Image image = with_edge(8, 6);
  EXPECT_DOUBLE_EQ(neighbour_error2(image, {0, 0, 4, 4}), 3 * 4 / 8.0);
  EXPECT_EQ(neighbour_error2(image, {4, 0, 8, 4}), 0);
  EXPECT_EQ(neighbour_error2(Image(1, 1), {0, 0, 1, 1}), 0);
}

// Of a pixel, at that distance.
const double width_of_pixel = 2 * std::tan(0.25) / 32 * 100;

SubpixelObjects subpixel_among(const std::vector<json>& spheres) {
  const Scene scene = scene_of(
      document(camera_json(32, 32, 0.5, {0, 0, 0}, {0, 0, 1}), spheres, {distant_json({0, 0, 1})}));
  return SubpixelObjects(pack_scene(scene, nullptr), 3);
}

TEST(SubpixelObjects, are_those_smaller_than_a_pixel_until_samples_must_meet_them) {
  const double pixel = width_of_pixel;
  // To the right of the middle and above it, in the middle of a pixel; a large one elsewhere.
  const SubpixelObjects one =
      subpixel_among({sphere_json({2.5 * pixel, 2.5 * pixel, 100}, 0.2 * pixel),
                      sphere_json({-6 * pixel, -6 * pixel, 100}, 3 * pixel)});
  constexpr std::size_t its_pixel = 13 * 32 + 18;
  EXPECT_GT(one.error2(its_pixel, 1), one.error2(its_pixel, 16));
  EXPECT_GT(one.error2(its_pixel, 16), 1e-3);
  EXPECT_LT(one.error2(its_pixel, 256), 1e-6);
  for (std::size_t i = 0; i < std::size_t{32} * 32; ++i)
    EXPECT_EQ(one.error2(i, 1) > 0, i == its_pixel) << i;

  const SubpixelObjects on_a_side =
      subpixel_among({sphere_json({3 * pixel, 2.5 * pixel, 100}, 0.2 * pixel)});
  EXPECT_NEAR(on_a_side.error2(its_pixel, 1) / on_a_side.error2(its_pixel + 1, 1), 1, 0.05);
  EXPECT_LT(on_a_side.error2(its_pixel, 1), one.error2(its_pixel, 1) / 3);
}

TEST(SubpixelObjects, hide_each_other) {
  const double pixel = width_of_pixel;
  constexpr std::size_t its_pixel = 13 * 32 + 18;
  const auto in_one_place = [&](int count) {
    return subpixel_among(
        std::vector<json>(static_cast<std::size_t>(count),
                          sphere_json({2.5 * pixel, 2.5 * pixel, 100}, 0.3 * pixel)));
  };
  // Each of twenty shows little of itself; but all of them cover no more than the pixel.
  EXPECT_LT(in_one_place(20).error2(its_pixel, 1), in_one_place(1).error2(its_pixel, 1));
  EXPECT_GT(in_one_place(20).error2(its_pixel, 16), 1e-6);
}

TEST(SubpixelObjects, are_missed_by_as_much_as_those_that_were_met_differ) {
  const double pixel = width_of_pixel;
  constexpr std::size_t its_pixel = 13 * 32 + 18;
  std::vector<json> spheres;
  for (int y = -8; y < 8; ++y)
    for (int x = -8; x < 8; ++x)
      spheres.push_back(sphere_json({(x + 0.5) * pixel, (y + 0.5) * pixel, 100}, 0.3 * pixel));
  const SubpixelObjects unknown = subpixel_among(spheres);
  const auto learnt = [&](float variance) {
    SubpixelObjects objects = unknown;
    PixelSpreads spreads(32, 32);
    std::fill(spreads.variance.begin(), spreads.variance.end(), variance);
    objects.learn_contrast(spreads, 16);
    return objects.error2(its_pixel, 16);
  };
  const double before = unknown.error2(its_pixel, 16);
  EXPECT_LT(learnt(0), before / 100);
  EXPECT_NEAR(learnt(0.1F) / learnt(0.05F), 2, 0.1);
  EXPECT_EQ(learnt(10), before);
}

}  // namespace
}  // namespace raytracer::test

// Places on soft lights, and who looks at which.
#include "engine/lights/light_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace raytracer {
namespace {

PackedLight soft_light(LightShape shape) {
  return {.kind = 0,
          .rays = LightRays::converging,
          .place = {0, 0, 1},
          .emission = {1, 1, 1},
          .fades = false,
          .shape = shape,
          .size = 0.3};
}

/// The unit square's place that became one in the unit disc.
std::pair<double, double> in_square(const Vec3& place) {
  const double turns = std::atan2(place.y, place.x) / (2 * std::numbers::pi);
  return {place.x * place.x + place.y * place.y, turns - std::floor(turns)};
}

TEST(LightPlaces, every_run_of_sets_has_a_place_in_each_rectangle_of_its_share) {
  const SoftLight soft =
      place_samples(soft_light(LightShape::disc), {.sets = 32, .per_set = 8, .is_alone = false});
  ASSERT_EQ(soft.places.size(), 256U);
  for (std::size_t count = 8; count <= 256; count *= 2)
    for (std::size_t begin = 0; begin < 256; begin += count)
      for (std::size_t columns = 1; columns <= count; columns *= 2) {
        const std::size_t rows = count / columns;
        std::set<std::pair<int, int>> met;
        for (std::size_t i = begin; i < begin + count; ++i) {
          const auto [u, v] = in_square(soft.places[i]);
          met.emplace(static_cast<int>(u * static_cast<double>(columns)),
                      static_cast<int>(v * static_cast<double>(rows)));
        }
        EXPECT_EQ(met.size(), count) << begin << ": " << columns << " x " << rows;
      }
}

TEST(LightPlaces, each_run_on_a_rim_goes_around_it_and_all_of_them_evenly) {
  const SoftLight soft =
      place_samples(soft_light(LightShape::disc), {.sets = 4, .per_set = 16, .on_rim = 32});
  const PlaceNumbers& numbers = soft.numbers;
  ASSERT_EQ(soft.places.size(), 4U * 16U + 32U);
  const auto widest_gap = [&](std::size_t first, std::size_t count) {
    std::set<double> turns;
    for (std::size_t i = first; i < first + count; ++i) {
      const auto [square, turn] = in_square(soft.places[i]);
      EXPECT_NEAR(square, 1, 1e-12);
      EXPECT_TRUE(numbers.is_on_rim(i));
      turns.insert(turn > 1 - 1e-9 ? 0 : turn);
    }
    EXPECT_EQ(turns.size(), count);
    double gap = *turns.begin() + 1 - *turns.rbegin();
    for (auto next = turns.begin(), turn = next++; next != turns.end(); turn = next++)
      gap = std::max(gap, *next - *turn);
    return gap;
  };
  ASSERT_EQ(numbers.rim_runs(), 4U);
  for (std::size_t run = 0; run < numbers.rim_runs(); ++run)
    EXPECT_NEAR(widest_gap(numbers.of_rim(run).first, numbers.of_rim(run).count), 1.0 / 8, 1e-9);
  EXPECT_NEAR(widest_gap(numbers.of_rim(0).first, 32), 1.0 / 32, 1e-9);
}

TEST(LightPlaces, each_that_a_point_asks_for_is_told_at_its_own_place) {
  const PlaceNumbers numbers{.sets = 4, .per_set = 16, .on_rim = 32};
  for (std::size_t set = 0; set < numbers.sets; ++set) {
    std::set<std::size_t> told;
    const auto ask = [&](const PlaceRange& range) {
      for (std::size_t i = 0; i < range.count; ++i) {
        EXPECT_EQ(numbers.told_of(range.first + i), range.told + i);
        told.insert(range.told + i);
      }
    };
    ask(numbers.of_set(set));
    EXPECT_EQ(numbers.set_of(numbers.of_set(set).first), set);
    for (std::size_t run = 0; run < numbers.rim_runs(); ++run) ask(numbers.of_rim(run));
    EXPECT_EQ(told.size(), numbers.told());
    EXPECT_EQ(*told.rbegin() + 1, numbers.told());
  }
}

TEST(LightPlaces, axes_of_a_sky_are_unit_and_all_above_it) {
  const SoftLight soft =
      place_samples(soft_light(LightShape::sky), {.sets = 16, .per_set = 16, .is_alone = false});
  Vec3 sum;
  for (const Vec3& axis : soft.places) {
    EXPECT_NEAR(length(axis), 1, 1e-12);
    EXPECT_GT(axis.z, 0);
    sum = sum + axis;
  }
  const Vec3 mean = 1.0 / static_cast<double>(soft.places.size()) * sum;
  EXPECT_NEAR(mean.x, 0, 0.01);
  EXPECT_NEAR(mean.y, 0, 0.01);
  EXPECT_NEAR(mean.z, 0.5, 0.005);  // a hemisphere's centroid
}

TEST(LightPlaces, neighbours_and_a_pixel_s_samples_use_different_sets) {
  for (const int sets : {4, 16, 128}) {
    std::set<int> of_square;
    for (int i = 0; i < 4; ++i) of_square.insert(light_set_of(i % 2, i / 2, 0, sets));
    EXPECT_EQ(of_square.size(), 4U) << sets;
    std::set<int> of_pixel;
    for (std::size_t nth = 0; nth < static_cast<std::size_t>(sets); ++nth)
      of_pixel.insert(light_set_of(1, 0, light_set_of_sample(nth, 0, sets), sets));
    EXPECT_EQ(of_pixel.size(), static_cast<std::size_t>(sets));
  }
}

TEST(LightPlaces, half_buffers_share_no_set) {
  for (const int sets : {2, 4, 16, 128})
    for (const std::size_t half : {1U, 2U, 8U, 24U, 64U, 300U}) {
      std::set<int> of_a;
      std::set<int> of_b;
      for (std::size_t nth = 0; nth < 2 * half; ++nth)
        (nth < half ? of_a : of_b).insert(light_set_of_sample(nth, half, sets));
      const auto each = std::min(half, static_cast<std::size_t>(sets) / 2);
      EXPECT_EQ(of_a.size(), each) << sets << ", " << half;
      EXPECT_EQ(of_b.size(), each) << sets << ", " << half;
      of_a.merge(of_b);
      EXPECT_EQ(of_a.size(), 2 * each) << sets << ", " << half;
    }
  EXPECT_EQ(light_set_of_sample(5, 4, 1), 0);
}

TEST(LightPlaces, a_refinement_uses_other_sets) {
  const auto sets_of = [](std::size_t samples) {
    std::set<int> used;
    for (std::size_t nth = 0; nth < samples; ++nth)
      used.insert(light_set_of_sample(nth, samples / 2, 128));
    return used;
  };
  std::set<int> used = sets_of(4);
  used.merge(sets_of(16));
  EXPECT_EQ(used.size(), 4U + 16U);
  used.merge(sets_of(32));
  EXPECT_EQ(used.size(), 4U + 16U + 32U);
}

}  // namespace
}  // namespace raytracer

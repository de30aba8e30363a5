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

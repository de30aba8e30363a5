// Places on soft lights, and who looks at which.
#include "engine/lights/light_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace raytracer {
namespace {

/// How often each set is looked at by samples from `begin` to `end`.
std::map<std::size_t, int> uses(std::size_t begin, std::size_t end, std::size_t half_count,
                                std::size_t count, std::size_t sets) {
  std::map<std::size_t, int> uses;
  for (std::size_t nth = begin; nth < end; ++nth) {
    const PlaceSets share = share_of_sets(nth, half_count, count, sets);
    for (std::size_t set = share.index; set < sets; set += share.step) ++uses[set];
  }
  return uses;
}

TEST(LightPlaces, each_half_of_the_samples_looks_at_all) {
  for (const std::size_t sets : {1U, 4U, 16U})
    for (const std::size_t count : {1U, 2U, 4U, 5U, 16U, 20U, 32U, 64U, 1000U}) {
      const std::size_t half = count / 2;
      if (half > 0) {
        EXPECT_EQ(uses(0, half, half, count, sets).size(), sets) << count;
      }
      EXPECT_EQ(uses(half, count, half, count, sets).size(), sets) << count;
    }
}

TEST(LightPlaces, samples_that_are_fewer_than_the_sets_look_at_each_once) {
  for (const std::size_t count : {4U, 8U, 16U, 32U})
    for (const auto& [set, times] : uses(0, count / 2, count / 2, count, 16))
      EXPECT_EQ(times, 1) << set << " of " << count;
}

TEST(LightPlaces, sets_that_are_shared_out_are_parts_of_one_lattice) {
  for (const LightShape shape : {LightShape::sky, LightShape::disc}) {
    const PackedLight light{.kind = 0,
                            .rays = LightRays::parallel,
                            .place = {0, 0, 1},
                            .emission = {1, 1, 1},
                            .fades = false,
                            .shape = shape,
                            .size = 0.3};
    const auto sorted = [&](const LightSampling& sampling) {
      std::vector<Vec3> places = place_samples(light, sampling).places;
      std::sort(places.begin(), places.end(),
                [](const Vec3& a, const Vec3& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
      return places;
    };
    const auto parts = sorted({.sets = 16, .per_set = 52, .is_shared_out = true});
    const auto whole = sorted({.sets = 1, .per_set = 832});
    ASSERT_EQ(parts.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i)
      EXPECT_NEAR(length(parts[i] - whole[i]), 0, 1e-12) << i;
  }
}

}  // namespace
}  // namespace raytracer

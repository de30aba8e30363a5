// Places on soft lights, and who looks at which.
#include "engine/lights/light_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

namespace raytracer {
namespace {

/// The weight that samples from `begin` to `end` give each set.
std::map<std::size_t, double> weights(std::size_t begin, std::size_t end, std::size_t half_count,
                                      std::size_t count, std::size_t sets) {
  std::map<std::size_t, double> weights;
  for (std::size_t nth = begin; nth < end; ++nth) {
    const PlaceSets share = share_of_sets(nth, half_count, count, sets);
    for (std::size_t set = share.index; set < sets; set += share.step)
      weights[set] += static_cast<double>(share.step) / static_cast<double>(sets);
  }
  return weights;
}

TEST(LightPlaces, each_half_of_the_samples_gives_all_sets_the_same_weight) {
  for (const std::size_t sets : {1U, 4U, 12U})
    for (const std::size_t count : {1U, 2U, 4U, 5U, 6U, 16U, 24U, 40U, 48U, 96U, 1000U}) {
      const std::size_t half = count / 2;
      const auto expect_even = [&](std::size_t begin, std::size_t end) {
        const auto all = weights(begin, end, half, count, sets);
        EXPECT_EQ(all.size(), sets) << count;
        for (const auto& [set, weight] : all)
          EXPECT_NEAR(weight, static_cast<double>(end - begin) / static_cast<double>(sets), 1e-9)
              << set << " of " << sets << ", " << count;
      };
      if (half > 0) expect_even(0, half);
      expect_even(half, count);
    }
}

TEST(LightPlaces, samples_share_sets_out_where_their_numbers_agree) {
  for (const auto& [count, step] : {std::pair(4U, 2U), {16U, 4U}, {24U, 12U}, {6U, 3U}, {10U, 1U}})
    EXPECT_EQ(share_of_sets(0, count / 2, count, 12).step, step) << count;
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
    const auto parts = sorted({.sets = 12, .per_set = 70, .is_shared_out = true});
    const auto whole = sorted({.sets = 1, .per_set = 840});
    ASSERT_EQ(parts.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i)
      EXPECT_NEAR(length(parts[i] - whole[i]), 0, 1e-12) << i;
  }
}

}  // namespace
}  // namespace raytracer

// How far estimates of errors are believed.

#include "engine/sample/error_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace raytracer::test {
namespace {

TEST(ConservativeSum, adds_less_where_many_have_an_error) {
  EXPECT_DOUBLE_EQ(conservative_sum(std::vector<double>{1}), 1 + 2 * std::sqrt(2));
  EXPECT_DOUBLE_EQ(conservative_sum(std::vector<double>(100, 0.01)), 1 + 0.2 * std::sqrt(2));
  EXPECT_DOUBLE_EQ(sum_of(std::vector<double>(100, 0.01)), 1);
}

TEST(ErrorMultiplier, is_less_where_edges_cross_pixels) {
  SceneStatistics statistics;
  statistics.all.subpixel = 1;
  const ErrorMultiplier of_small = choose_error_multiplier(statistics);
  EXPECT_EQ(of_small.initial, 1);
  statistics.all.subpixel = 0;
  EXPECT_LT(choose_error_multiplier(statistics).initial, 1);
  EXPECT_LT(choose_error_multiplier(statistics).least, of_small.least);
}

}  // namespace
}  // namespace raytracer::test

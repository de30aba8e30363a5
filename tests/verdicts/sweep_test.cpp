// Which of many settings is the one to compare with.
#include "tests/measure/tradeoff/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace raytracer::published {
namespace {

// An error need not fall with the time: more samples of a regular grid may meet an edge worse.
const Sweep sweep{
    {"a", 4, 0.02}, {"b", 9, 0.008}, {"c", 16, 0.011}, {"d", 8, 0.009}, {"e", 25, 0.004}};

TEST(Sweep, cheapest_is_the_fastest_that_keeps_the_target) {
  EXPECT_EQ(cheapest_within(sweep, 0.03), 0U);
  EXPECT_EQ(cheapest_within(sweep, 0.01), 3U);
  EXPECT_EQ(cheapest_within(sweep, 0.008), 1U);
  EXPECT_EQ(cheapest_within(sweep, 0.005), 4U);
}

TEST(Sweep, target_that_no_setting_keeps_has_no_cheapest) {
  EXPECT_FALSE(cheapest_within(sweep, 0.0039));
  EXPECT_FALSE(cheapest_within({}, 1));
}

TEST(Sweep, cheapest_few_are_the_fastest_in_turn) {
  EXPECT_EQ(cheapest_few_within(sweep, 0.01, 2), (std::vector<std::size_t>{3, 1}));
  EXPECT_EQ(cheapest_few_within(sweep, 0.01, 9), (std::vector<std::size_t>{3, 1, 4}));
  EXPECT_TRUE(cheapest_few_within(sweep, 0.001, 2).empty());
}

TEST(Sweep, least_error_is_that_of_the_best) {
  EXPECT_EQ(least_error(sweep), 0.004);
  EXPECT_TRUE(std::isinf(least_error({})));
}

TEST(Sweep, front_rises_in_time_and_falls_in_error) {
  std::string names;
  for (const SweepPoint& point : front(sweep)) names += point.setting;
  EXPECT_EQ(names, "adbe");
}

}  // namespace
}  // namespace raytracer::published

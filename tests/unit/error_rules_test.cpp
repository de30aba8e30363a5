// How far estimates of errors are believed.

#include "engine/sample/error_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace raytracer::test {
namespace {

TEST(ConservativeSum, AddsLessWhereManyHaveAnError) {
  EXPECT_DOUBLE_EQ(conservative_sum(std::vector<double>{1}), 1 + 2 * std::sqrt(2));
  EXPECT_DOUBLE_EQ(conservative_sum(std::vector<double>(100, 0.01)), 1 + 0.2 * std::sqrt(2));
}

TEST(ErrorScale, IsLessWhereEdgesCrossPixels) {
  Census census;
  census.small_spheres = 1;
  const ErrorScale of_small = error_scale(census);
  EXPECT_EQ(of_small.first, 1);
  census.small_spheres = 0;
  EXPECT_LT(error_scale(census).first, 1);
  EXPECT_LT(error_scale(census).least, of_small.least);
}

}  // namespace
}  // namespace raytracer::test

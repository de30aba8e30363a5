// Vectors at ordinary and at extreme sizes.

#include "engine/math/vec.h"

#include <gtest/gtest.h>

#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

TEST(Vec, operators_work_by_coordinate) {
  const Vec3 a{1, 2, 3};
  const Vec3 b{4, -5, 6};
  EXPECT_EQ(a + b, (Vec3{5, -3, 9}));
  EXPECT_EQ(a - b, (Vec3{-3, 7, -3}));
  EXPECT_EQ(-a, (Vec3{-1, -2, -3}));
  EXPECT_EQ(a * b, (Vec3{4, -10, 18}));
  EXPECT_EQ(2 * a, (Vec3{2, 4, 6}));
  EXPECT_EQ(a * 2, (Vec3{2, 4, 6}));
  EXPECT_EQ(a / 2, (Vec3{0.5, 1, 1.5}));
  EXPECT_EQ(dot(a, b), 12);
  EXPECT_EQ(max_abs(b), 6);
  EXPECT_EQ(max_abs({0, -7, 3}), 7);
}

TEST(Vec, cross_of_x_and_y_is_z) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross({0, 1, 0}, {0, 0, 1}), (Vec3{1, 0, 0}));
  EXPECT_EQ(cross({0, 0, 1}, {1, 0, 0}), (Vec3{0, 1, 0}));
}

TEST(Vec, cross_is_antisymmetric_to_the_bit) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random.point(-1, 1);
    const Vec3 b = random.point(-1, 1);
    EXPECT_EQ(cross(a, b), -cross(b, a));
  }
}

TEST(Vec, unit_has_length_one_at_any_size) {
  Random random(2);
  for (int exponent = -1070; exponent <= 1023; exponent += 7) {
    const Vec3 direction = random.direction();
    const Vec3 result = unit(scaled(direction, exponent));
    EXPECT_NEAR(length(result), 1, 1e-15) << exponent;
    if (exponent > -1000) {
      EXPECT_LT(max_abs(result - direction), 1e-15) << exponent;
    }
  }
  EXPECT_EQ(unit({0, 0, 5e-324}), (Vec3{0, 0, 1}));
  EXPECT_EQ(unit({-1.7e308, 0, 0}), (Vec3{-1, 0, 0}));
  EXPECT_NEAR(length(unit({1.7e308, 1.7e308, 1.7e308})), 1, 1e-15);
  EXPECT_NEAR(unit({1e300, 1, 0}).y, 1e-300, 1e-310);
}

TEST(Vec, unit_of_zero_is_zero) { EXPECT_EQ(unit(Vec3{}), Vec3{}); }

TEST(Vec, reflected_keeps_the_tangent_and_turns_the_normal_part) {
  EXPECT_EQ(reflected({1, -2, 3}, {0, 1, 0}), (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace raytracer::test

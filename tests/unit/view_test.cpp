// The camera: which way each pixel looks.

#include <gtest/gtest.h>

#include <numbers>

#include "engine/scene/camera.h"
#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

using std::numbers::pi;

Camera camera(const Vec3& origin, const Vec3& look_at, double fov = 1, int width = 4,
              int height = 4) {
  return {origin, look_at, {0, 1, 0}, fov, width, height};
}

void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = 1e-15) {
  EXPECT_LE(max_abs(actual - expected), tolerance)
      << actual.x << ' ' << actual.y << ' ' << actual.z << " is not " << expected.x << ' '
      << expected.y << ' ' << expected.z;
}

/// Where the camera has its right side and its upper side.
Vec3 rightwards(const Camera& c) { return unit(make_view(c).right); }
Vec3 upwards(const Camera& c) { return unit(make_view(c).up); }

TEST(View, looks_at_look_at_in_the_middle_of_the_image) {
  const View view = make_view(camera({1, 2, 3}, {4, -2, 15}));
  expect_near(view.direction(2, 2), unit(Vec3{3, -4, 12}));
}

TEST(View, has_x_to_the_right_and_y_up_when_it_looks_along_z) {
  const View view = make_view(camera({0, 0, 0}, {0, 0, 5}));
  EXPECT_GT(view.direction(3, 2).x, 0);
  EXPECT_NEAR(view.direction(3, 2).y, 0, 1e-16);
  EXPECT_GT(view.direction(2, 3).y, 0);
  EXPECT_NEAR(view.direction(2, 3).x, 0, 1e-16);
}

TEST(View, is_up_cross_d_to_the_right_and_d_cross_u_upwards) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Camera c = camera(random.point(-5, 5), random.point(-5, 5));
    c.up = random.direction();
    const Vec3 d = unit(c.look_at - c.origin);
    const Vec3 u = unit(cross(c.up, d));
    expect_near(rightwards(c), u, 1e-13);
    expect_near(upwards(c), cross(d, u), 1e-13);
    EXPECT_GT(dot(upwards(c), c.up), 0);
  }
}

TEST(View, spans_the_field_of_view_from_the_left_to_the_right_side) {
  for (const double fov : {1e-6, 0.5, 1.0, 2.0, 3.0, 3.14}) {
    const View view = make_view(camera({0, 0, 0}, {0, 0, 1}, fov, 40, 30));
    const Vec3 left = view.direction(0, 15);
    const Vec3 right = view.direction(40, 15);
    EXPECT_NEAR(std::atan2(length(cross(left, right)), dot(left, right)), fov, 1e-12);
    EXPECT_NEAR(right.x / right.z / std::tan(fov / 2), 1, 1e-9);
  }
}

TEST(View, follows_the_formula_for_images_that_are_not_square) {
  const Camera c = camera({1, -2, 3}, {5, 5, 5}, 1.2, 70, 50);
  const View view = make_view(c);
  const Vec3 d = unit(c.look_at - c.origin);
  const Vec3 u = unit(cross(c.up, d));
  const Vec3 v = cross(d, u);
  const double tw = std::tan(c.fov / 2);
  const double th = tw * c.height / c.width;
  for (int j = 0; j < c.height; j += 7) {
    for (int i = 0; i < c.width; i += 7) {
      const double x = i + 0.5;
      const double y = c.height - j - 0.5;
      expect_near(view.direction(x, y),
                  unit(d + (2 * x / c.width - 1) * tw * u + (2 * y / c.height - 1) * th * v),
                  1e-15);
    }
  }
}

TEST(View, takes_the_field_of_view_modulo_two_pi) {
  for (const double turns : {-2.0, -1.0, 1.0, 2.0, 7.0}) {
    const View once = make_view(camera({0, 0, 0}, {0, 0, 1}, 2 * pi / 3));
    const View turned = make_view(camera({0, 0, 0}, {0, 0, 1}, 2 * pi / 3 + turns * 2 * pi));
    for (int i = 0; i <= 4; ++i)
      expect_near(turned.direction(i, 4 - 0.3 * i), once.direction(i, 4 - 0.3 * i), 1e-13);
  }
}

TEST(View, with_up_parallel_takes_the_axis_least_aligned_of_equals_x_then_z_then_y) {
  struct Row {
    Vec3 d;
    Vec3 axis;
  };
  for (const auto& [d, axis] :
       {Row{{0, 1, 0}, {1, 0, 0}}, Row{{0, -1, 0}, {1, 0, 0}}, Row{{0, 0, 1}, {1, 0, 0}},
        Row{{1, 0, 0}, {0, 0, 1}}, Row{{1, 1, 0}, {0, 0, 1}}, Row{{1, 0, 1}, {0, 1, 0}},
        Row{{1, 1, 1}, {1, 0, 0}}, Row{{2, 1, 1}, {0, 0, 1}}, Row{{1, 2, 1}, {1, 0, 0}},
        Row{{1, 1, 2}, {1, 0, 0}}, Row{{3, 1, 2}, {0, 1, 0}}, Row{{-3, 2, -1}, {0, 0, 1}}}) {
    for (const double up_sign : {1.0, -1.0}) {
      Camera c = camera({0, 0, 0}, d);
      c.up = up_sign * 3 * d;
      expect_near(rightwards(c), unit(cross(axis, unit(d))));
    }
  }
}

TEST(View, treats_up_as_parallel_within_a_trillionth) {
  Camera c = camera({0, 0, 0}, {0, 1, 0});
  c.up = {0, 1, 1e-13};
  expect_near(rightwards(c), {0, 0, 1});  // x cross y
  c.up = {0, 1, 1e-11};
  expect_near(rightwards(c), {-1, 0, 0}, 1e-4);  // up cross d, as ever
}

TEST(View, does_not_depend_on_the_length_of_up_or_of_the_sight) {
  const View plain = make_view(camera({0, 0, 0}, {1, 2, 3}));
  for (const double size : {1e-300, 1e-10, 1e10, 1e300}) {
    Camera c = camera({0, 0, 0}, size * Vec3{1, 2, 3});
    c.up = size * c.up;
    expect_near(make_view(c).direction(0.5, 0.5), plain.direction(0.5, 0.5));
  }
}

TEST(View, sees_the_nearest_and_the_farthest_look_at) {
  expect_near(make_view(camera({0, 0, 0}, {0, 0, 5e-324})).direction(2, 2), {0, 0, 1});
  expect_near(make_view(camera({0, 0, -1.7e308}, {0, 0, 1.7e308})).direction(2, 2), {0, 0, 1});
}

}  // namespace
}  // namespace raytracer::test

// The first sphere's disc in the image, against its closed form.
//
// The camera at the origin looks along +z with tw = tan((8 pi / 3) / 2 mod pi) = tan(pi / 3), so a
// pixel of an image w wide is 2 tw / w wide at distance 1. The sphere (0, 0, 1), r, is seen up to
// the angle asin(r) from the axis: a disc around the image's middle of radius
//   tan(asin(r)) * w / (2 tw) = r / sqrt(1 - r^2) * 350 / sqrt(3) = 88.19 pixels for r = 0.4.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr int picture_width = 700;
constexpr int picture_height = 500;

json first_sphere(const Vec3& center, double radius) {
  return document(
      camera_json(picture_width, picture_height, 8 * std::numbers::pi / 3, {0, 0, 0}, {0, 0, 5}),
      {sphere_json(center, radius, constant_material({1, 1, 1}))}, {distant_json({0, 0, 1})});
}

const double disc_radius_px =
    0.4 / std::sqrt(1 - 0.4 * 0.4) * picture_width / (2 * std::tan(std::numbers::pi / 3));

TEST(Disc, of_the_first_sphere_has_the_radius_of_the_formula_by_its_area) {
  EXPECT_NEAR(disc_radius_px, 88.19, 0.01);
  const int lit = count_lit(image_of(first_sphere({0, 0, 1}, 0.4)));
  EXPECT_NEAR(std::sqrt(lit / std::numbers::pi), disc_radius_px, 0.05);
}

TEST(Disc, of_the_first_sphere_has_the_radius_of_the_formula_by_its_extents) {
  const Image image = image_of(first_sphere({0, 0, 1}, 0.4));
  int left = picture_width, right = -1, top = picture_height, bottom = -1;
  for (int y = 0; y < picture_height; ++y) {
    for (int x = 0; x < picture_width; ++x) {
      if (color_at(image, x, y) == Vec3{}) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  // The outermost pixels are those whose centres lie within.
  EXPECT_NEAR((right - left + 1) / 2.0, disc_radius_px, 0.6);
  EXPECT_NEAR((bottom - top + 1) / 2.0, disc_radius_px, 0.6);
  EXPECT_EQ(left + right, picture_width - 1);
  EXPECT_EQ(top + bottom, picture_height - 1);
}

TEST(Disc, of_the_first_sphere_has_every_pixel_whose_centre_lies_within) {
  const Image image = image_of(first_sphere({0, 0, 1}, 0.4));
  for (int y = 0; y < picture_height; ++y) {
    for (int x = 0; x < picture_width; ++x) {
      const double from_middle =
          std::hypot(x + 0.5 - picture_width / 2.0, y + 0.5 - picture_height / 2.0);
      ASSERT_GT(std::abs(from_middle - disc_radius_px), 1e-9);
      EXPECT_EQ(color_at(image, x, y).x > 0, from_middle < disc_radius_px) << x << ' ' << y;
    }
  }
}

TEST(Disc, lies_to_the_right_for_a_positive_x_and_above_for_a_positive_y) {
  // The point (0.2, 0.1, 1) is 0.2 * 350 / sqrt(3) right of and half of that above the middle.
  const Image image = image_of(first_sphere({0.2, 0.1, 1}, 0.01));
  const double scale = picture_width / (2 * std::sqrt(3.0));
  double x_sum = 0, y_sum = 0, count = 0;
  for (int y = 0; y < picture_height; ++y) {
    for (int x = 0; x < picture_width; ++x) {
      if (color_at(image, x, y) == Vec3{}) continue;
      x_sum += x + 0.5;
      y_sum += y + 0.5;
      ++count;
    }
  }
  ASSERT_GT(count, 0);
  EXPECT_NEAR(x_sum / count, picture_width / 2.0 + 0.2 * scale, 0.3);
  EXPECT_NEAR(y_sum / count, picture_height / 2.0 - 0.1 * scale, 0.3);
}

}  // namespace
}  // namespace raytracer::test

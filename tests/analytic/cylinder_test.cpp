// Cylinders in the image, against their closed forms.
//
// The camera at the origin looks along +z; a point (x, y, z) is seen at (x, y) / z, of which
// `pixels_at_1` pixels are 1. A cylinder along y through (0, 0, D) is seen up to the planes through
// the eye that touch it, at the angle asin(r / D): between two upright lines.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

constexpr int width = 160;
constexpr int height = 120;
constexpr double fov = 1.2;
const double pixels_at_1 = width / (2 * std::tan(fov / 2));
const json camera = camera_json(width, height, fov);

const json white = constant_material({1, 1, 1});
constexpr bool open = false;

/// Where the centre of a pixel is seen, at distance 1.
double seen_x(int x) { return (x + 0.5 - width / 2.0) / pixels_at_1; }
double seen_y(int y) { return (height / 2.0 - y - 0.5) / pixels_at_1; }

/// Expects each pixel to be lit if `is_lit(x, y)` of where its centre is seen.
template <typename IsLit>
void expect_lit(json text, const IsLit& is_lit) {
  for (const auto& [precision, unused] : tolerances) {
    text["render"]["precision"] = precision;
    const Image image = image_of(text);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        EXPECT_EQ(color_at(image, x, y) != Vec3{}, is_lit(seen_x(x), seen_y(y)))
            << precision << ' ' << x << ' ' << y;
  }
}

TEST(Cylinder, seen_from_the_side_is_as_wide_as_the_planes_that_touch_it) {
  for (const double radius : {0.3, 1.0, 1.9}) {
    for (const double away : {2.5, 7.0}) {
      const double half_width = std::tan(std::asin(radius / away));
      // Its ends are out of sight, so that caps make no difference.
      for (const bool caps : {true, open})
        expect_lit(
            document(camera, {cylinder_json({0, -30, away}, {0, 20, away}, radius, caps, white)},
                     {distant_json({0, 0, 1})}),
            [&](double x, double) { return std::abs(x) < half_width; });
    }
  }
}

TEST(Cylinder, far_away_is_two_radii_wide_at_its_distance) {
  const double away = 1e6;
  json text = document(camera_json(width, height, 1e-5),
                       {cylinder_json({0, -1e3, away}, {0, 1e3, away}, 2, true, white)},
                       {distant_json({0, 0, 1})});
  const double pixels = 2 * 2 / away * width / (2 * std::tan(1e-5 / 2));
  EXPECT_NEAR(count_lit(image_of(text)) / static_cast<double>(height), pixels, 1);
}

TEST(Cylinder, that_is_open_is_a_ring_along_its_axis) {
  // From the rim at z = 2 to the one at z = 6, lit from within.
  const json text = document(camera, {cylinder_json({0, 0, 6}, {0, 0, 2}, 0.8, open, white)},
                             {point_json({0, 0, 3}, 1)});
  expect_lit(text, [](double x, double y) {
    const double from_axis = std::hypot(x, y);
    return 0.8 / 6 < from_axis && from_axis < 0.8 / 2;
  });
}

TEST(Cylinder, that_is_closed_is_a_disc_along_its_axis) {
  const json text = document(camera, {cylinder_json({0, 0, 6}, {0, 0, 2}, 0.8, true, white)},
                             {distant_json({0, 0, 1})});
  expect_lit(text, [](double x, double y) { return std::hypot(x, y) < 0.8 / 2; });
}

TEST(Cylinder, has_a_cap_of_one_normal) {
  // L = (0.6, 0, -0.8) against N = (0, 0, -1), whatever the pixel.
  const Vec3 color{0.5, 1, 0.25};
  for (const Vec3& from : {Vec3{0, 0, 5}, Vec3{0.5, -1, 5}})
    for (const bool turned : {false, true}) {
      const Vec3 to = from + Vec3{0, 0, 3};
      expect_color(document(camera,
                            {cylinder_json(turned ? to : from, turned ? from : to, 9, true,
                                           diffuse_material(color))},
                            {distant_json({-3, 0, 4}, 0.5)}),
                   color * (0.8 * 0.5));
    }
}

TEST(Cylinder, has_caps_of_one_normal_on_the_inside) {
  // The eye is inside, and only the far cap is seen.
  const json text = document(camera_json(40, 30, 0.3),
                             {cylinder_json({0, 0, -2}, {0, 0, 1}, 1, true, diffuse_material())},
                             {point_json({0, 0, 0}, 0), distant_json({-3, 0, 4}, 0.5)});
  expect_exact_color(text, {0, 0, 0});
  json unshadowed = text;
  unshadowed["shadows"] = "off";
  expect_gray(unshadowed, 0.8 * 0.5);
}

TEST(Cylinder, is_shaded_by_the_angle_around_its_axis) {
  // Seen in the plane across the axis the ray s (u, 1) meets it where |s (u, 1) - (0, D)| = r.
  constexpr double away = 5;
  for (const double radius : {0.5, 2.0}) {
    for (const bool caps : {true, open}) {
      json text = document(
          camera, {cylinder_json({0, -40, away}, {0, 30, away}, radius, caps, diffuse_material())},
          {distant_json({0.6, 0.3, 0.8}, 0.7)});
      const Vec3 light = -unit(Vec3{0.6, 0.3, 0.8});
      // Normals turn by the root of what the place is off by near the outline.
      for (const auto& [precision, tolerance] : {std::pair{"double", 1e-6}, {"auto", 1e-3}}) {
        text["render"]["precision"] = precision;
        const Image image = image_of(text);
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            const double u = seen_x(x);
            const double square = 1 + u * u;
            const double room = away * away - square * (away * away - radius * radius);
            const double s = room > 0 ? (away - std::sqrt(room)) / square : 0;
            const Vec3 normal{s * u / radius, 0, (s - away) / radius};
            const double expected = room > 0 ? 0.7 * std::max(0.0, dot(normal, light)) : 0;
            ASSERT_NEAR(color_at(image, x, y).x, expected, tolerance)
                << precision << ' ' << x << ' ' << y;
          }
      }
    }
  }
}

TEST(Cylinder, that_is_a_closed_mirror_lets_nothing_out) {
  // Wherever a ray goes it meets the inside again.
  const json mirror{{"ka", 1}, {"kd", 0}, {"ks", 0}, {"reflectivity", 0.5}};
  for (const Vec3& axis : {Vec3{0, 1, 0}, Vec3{1, 2, -0.5}}) {
    json text =
        document(camera_json(40, 30, 2), {cylinder_json(-1.25 * axis, axis, 0.75, true, mirror)});
    text["shadows"] = "ambient";
    text["ambient"] = 0.3;
    text["background"] = {1, 1, 1};  // is never seen
    for (const int depth : {0, 1, 2, 5, 10}) {
      text["render"]["max_depth"] = depth;
      expect_gray(text, 0.3 * (2 - std::pow(0.5, depth)));
    }
  }
}

}  // namespace
}  // namespace raytracer::test

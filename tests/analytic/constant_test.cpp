// Images that have one value everywhere, known by hand.

#include <gtest/gtest.h>

#include <numbers>

#include "engine/math/transfer.h"
#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

using std::numbers::pi;

TEST(Constant, inside_a_sphere_with_a_light_at_its_centre_every_pixel_is_equal) {
  // N = L = V = H: kd + ks of what falls on the sphere, and the ambient part.
  const double radius = 2.5;
  const double intensity = 60;
  const Vec3 color{0.9, 0.5, 0.25};
  const Vec3 light_color{0.8, 1, 0.6};
  const Vec3 expected =
      color * (0.8 * 0.2) +
      color * light_color * ((0.6 + 0.3) * intensity / (4 * pi * radius * radius));
  for (const double fov : {0.1, 1.0, 3.1}) {
    json text = document(
        camera_json(70, 50, fov, {1, 2, 3}, {4, 4, 4}),
        {sphere_json({1, 2, 3}, radius,
                     {{"color", vector_json(color)}, {"ka", 0.8}, {"kd", 0.6}, {"ks", 0.3}})},
        {point_json({1, 2, 3}, intensity, light_color)});
    expect_color(text, expected);
    text["render"]["samples"] = 7;
    expect_color(text, expected);
  }
}

TEST(Constant, a_plane_under_a_distant_light_is_lamberts_cosine) {
  // L = (0.6, 0, -0.8) against N = (0, 0, -1), whatever the pixel.
  const json text = document(camera_json(40, 30, 1.5),
                             {plane_json({0, 0, 5}, {0, 0, 2}, diffuse_material({0.5, 1, 0.25}))},
                             {distant_json({-3, 0, 4}, 0.5)});
  expect_color(text, Vec3{0.5, 1, 0.25} * (0.8 * 0.5));
}

TEST(Constant, a_plane_lit_from_behind_is_black) {
  const json text =
      document(camera_json(8, 8), {plane_json({0, 0, 5}, {0, 0, 1})}, {distant_json({0, 0, -1})});
  expect_exact_color(text, {0, 0, 0});
}

TEST(Constant, a_plane_lit_from_behind_shows_its_ambient_part_under_the_other_shadows) {
  json text = document(camera_json(8, 8), {plane_json({0, 0, 5}, {0, 0, 1}, {{"ka", 0.5}})},
                       {distant_json({0, 0, -1})});
  text["ambient"] = 0.4;
  for (const char* shadows : {"ambient", "off"}) {
    text["shadows"] = shadows;
    expect_gray(text, 0.2);
  }
}

TEST(Constant, nothing_is_the_background) {
  json text = document(camera_json(33, 65));
  text["background"] = {0.1, 0.55, 1};
  expect_color(text, {0.1, 0.55, 1});
}

/// Where rays are traced and where it is known that they meet nothing, at every number of samples.
TEST(Constant, background_has_no_seams) {
  json text = document(camera_json(67, 45), {sphere_json({0.1, 0.2, 9}, 0.4)});
  text["background"] = {0.3, 0.1, 0.7};
  for (const int samples : {1, 3, 4, 9, 13, 25, 36, 100}) {
    text["render"]["samples"] = samples;
    const Image image = image_of(text);
    const Vec3 plain = color_at(image, 0, 0);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double difference = distance(color_at(image, x, y), plain);
        EXPECT_TRUE(difference == 0 || difference > 1e-3)
            << samples << " samples, pixel " << x << ' ' << y << ": " << difference;
      }
  }
}

TEST(Constant, the_background_is_encoded_once_under_srgb) {
  json text = document(camera_json(3, 3));
  text["background"] = {0.5, 0.18, 1};
  text["render"]["transfer"] = "srgb";
  expect_color(text, {0.7353569830524495, 0.46135612950044164, 1});
}

TEST(Constant, neither_lights_nor_objects_is_black_under_every_shadow) {
  json text = document(camera_json(8, 8), {plane_json({0, 0, 5}, {0, 0, 1})});
  text["background"] = {1, 1, 1};
  expect_exact_color(text, {0, 0, 0});
  text["shadows"] = "ambient";
  expect_gray(text, 0.2);
}

TEST(Constant, values_above_one_are_clamped) {
  const json text = document(camera_json(8, 8), {plane_json({0, 0, 5}, {0, 0, 1})},
                             {distant_json({0, 0, 1}, 1e300)});
  expect_exact_color(text, {1, 1, 1});
}

/// Two lights' ambient parts overflow, and the dark channel is 0 of it.
TEST(Constant, sum_of_huge_ambient_parts_leaves_a_dark_channel_dark) {
  const json plane = plane_json({0, 0, 5}, {0, 0, 1}, {{"color", {1, 0, 0.5}}});
  json text =
      document(camera_json(8, 8), {plane}, {distant_json({0, 0, 1}), distant_json({0, 0.1, 1})});
  for (const double ambient : {1e37, 1.7e38, 3e38, 1e300, 1.7e308}) {
    text["ambient"] = ambient;
    expect_exact_color(text, {1, 0, 1});
  }
}

}  // namespace
}  // namespace raytracer::test

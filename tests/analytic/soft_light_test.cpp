// Light from skies and discs, where it is known by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

json sky_json(double intensity) { return {{"type", "sky"}, {"intensity", intensity}}; }

json lamp_json(const Vec3& position, double radius) {
  json lamp = point_json(position, 0.8);
  lamp["falloff"] = "none";
  lamp["radius"] = radius;
  return lamp;
}

/// Where the one pixel's ray meets it, its normal points at the eye.
json wall() { return plane_json({0, 0, 5}, {0, 0, -1}, diffuse_material()); }

/// Hides what is to the right of x in the plane of z = 2.
json half_plane(double x) {
  return mesh_json({{x, -1e3, 2}, {x, 1e3, 2}, {1e3, 0, 2}}, {{0, 1, 2}});
}

/// What is left of a unit disc of which a line that far from its middle cuts off a segment.
double left_of_disc(double distance) {
  return 1 -
         (std::acos(distance) - distance * std::sqrt(1 - distance * distance)) / std::numbers::pi;
}

TEST(SoftLight, sky_over_a_lone_sphere_is_the_same_everywhere) {
  const json sphere = sphere_json({0, 0, 5}, 2, diffuse_material({0.5, 0.25, 1}));
  expect_color(document(camera_json(9, 9, 0.3), {sphere}, {sky_json(0.5)}), {0.25, 0.125, 0.5});
}

TEST(SoftLight, sky_has_no_highlight) {
  json shiny = diffuse_material();
  shiny["ks"] = 1;
  shiny["shininess"] = 1;
  expect_gray(document(camera_json(), {sphere_json({0, 0, 5}, 2, shiny)}, {sky_json(0.5)}), 0.5);
}

TEST(SoftLight, sky_reaches_a_wall_in_a_corner_by_half) {
  // The other wall hides a quarter of the sphere of directions, half of them by the cosine.
  const json other = plane_json({1e-9, 0, 0}, {-1, 0, 0});
  const json text = document(camera_json(), {wall(), other}, {sky_json(0.8)});
  EXPECT_NEAR(only_color(text).x, 0.4, 0.02);
}

TEST(SoftLight, what_is_beyond_a_skys_reach_hides_nothing) {
  const json other = plane_json({1, 0, 0}, {-1, 0, 0});
  for (const double reach : {1e-300, 1e-9, 0.99}) {
    json sky = sky_json(0.8);
    sky["reach"] = reach;
    expect_gray(document(camera_json(), {wall(), other}, {sky}), 0.8);
  }
  json sky = sky_json(0.8);
  sky["reach"] = 3;
  EXPECT_LT(only_color(document(camera_json(), {wall(), other}, {sky})).x, 0.79);
}

TEST(SoftLight, half_planes_penumbra_is_the_discs_segment) {
  for (const double edge : {0.05, 0.3, 0.9}) {
    json sun = distant_json({0, 0, 1}, 0.8);
    sun["angle"] = 2 * std::atan(1.0 / 3);  // 1 wide in the half plane
    for (const json& light : {sun, lamp_json({0, 0, -1}, 2)}) {
      const json text = document(camera_json(), {wall(), half_plane(edge)}, {light});
      EXPECT_NEAR(only_color(text).x, 0.8 * left_of_disc(edge), 0.02) << edge << ' ' << light;
    }
  }
}

TEST(SoftLight, a_sun_as_wide_as_the_sky_lights_by_its_discs_segment) {
  json sun = distant_json({0, 0, 1}, 0.8);
  sun["angle"] = 3;
  const double reach = 3 * std::tan(1.5);  // in the half plane
  for (const double edge : {2.0, 20.0, 40.0})
    EXPECT_NEAR(only_color(document(camera_json(), {wall(), half_plane(edge)}, {sun})).x,
                0.8 * left_of_disc(edge / reach), 0.02)
        << edge;
}

TEST(SoftLight, a_small_far_lamp_tends_to_a_point) {
  for (const double radius : {1e-300, 1e-9, 1e-3}) {
    for (const double edge : {2.2, 2.3}) {  // the light passes by 2.25
      json lamp = lamp_json({6e3, 0, -8e3}, radius);
      const Vec3 soft = only_color(document(camera_json(), {wall(), half_plane(edge)}, {lamp}));
      lamp.erase("radius");
      const Vec3 hard = only_color(document(camera_json(), {wall(), half_plane(edge)}, {lamp}));
      EXPECT_NEAR(soft.x, hard.x, 1e-6);
      EXPECT_EQ(hard.x > 0, edge > 2.25);
    }
  }
}

TEST(SoftLight, tends_to_hard_light) {
  for (const double size : {1e-300, 1e-12, 1e-6}) {
    for (const double edge : {0.1, -0.1}) {
      json sun = distant_json({-0.6, 0, 0.8}, 0.8);
      const double hard = only_color(document(camera_json(), {wall(), half_plane(edge)}, {sun})).x;
      sun["angle"] = size;
      EXPECT_NEAR(only_color(document(camera_json(), {wall(), half_plane(edge)}, {sun})).x, hard,
                  1e-6);
    }
  }
}

TEST(SoftLight, brings_the_ambient_part_where_it_is_seen) {
  json material = diffuse_material();
  material["ka"] = 1;
  const json plane = plane_json({0, 0, 5}, {0, 0, -1}, material);
  json text = document(camera_json(), {plane}, {sky_json(0.5)});
  text["ambient"] = 0.25;
  for (const char* const shadows : {"black", "ambient", "off"}) {
    text["shadows"] = shadows;
    expect_gray(text, 0.75);
  }
  json hidden = text;  // by a sphere around the wall's visible part
  hidden["shadows"] = "black";
  hidden["lights"][0] = distant_json({0, 0, -1}, 0.5);
  hidden["lights"][0]["angle"] = 0.5;
  expect_gray(hidden, 0);
}

/// Touches the half plane's shadow in (0, 0, 5) from the right: from there it is a cap of
/// directions that begins where the half plane does.
json ball_as_half_plane(double x) {
  constexpr double radius = 1;
  constexpr double distance = 1.2;
  const double middle = std::atan(x / 3) + std::asin(radius / distance);
  return sphere_json({distance * std::sin(middle), 0, 5 - distance * std::cos(middle)}, radius);
}

TEST(SoftLight, is_seen_as_soon_as_an_edge_uncovers_its_rim) {
  json material = diffuse_material();
  material["ka"] = 1;
  material["kd"] = 0;
  const json plane = plane_json({0, 0, 5}, {0, 0, -1}, material);
  json sun = distant_json({0, 0, 1}, 0.8);
  sun["angle"] = 2 * std::atan(1.0 / 3);  // 1 wide in the half plane
  // So many spheres that what hides the sun is swept.
  json crowd{{"type", "spheres"}, {"radius", 0.01}, {"centers", json::array()}};
  for (int i = 0; i < 2100; ++i) crowd["centers"].push_back({50 + 0.1 * i, 0, 2});
  for (const json& light : {sun, lamp_json({0, 0, -1}, 2)})
    for (const double edge : {-0.99, -1.01}) {
      for (const std::vector<json>& objects :
           {std::vector{plane, half_plane(edge)}, std::vector{plane, ball_as_half_plane(edge)},
            std::vector{plane, ball_as_half_plane(edge), crowd}}) {
        json text = document(camera_json(1, 1, 1e-6, {-2, 0, 4}, {0, 0, 5}), objects, {light});
        text["ambient"] = 0.25;
        for (const json& render : {json{{"samples", 1}}, json{{"samples", 4}},
                                   json{{"samples", 64}}, json{{"target_rmse", 0.01}}}) {
          text["render"] = render;
          EXPECT_EQ(only_color(text).x, edge > -1 ? 0.25 : 0)
              << light << edge << render << objects.size() << objects[1]["type"];
        }
      }
    }
}

TEST(SoftLight, shines_through_glass_by_its_transparency) {
  const json glass = {{"transparency", 0.5}, {"kd", 0}, {"ks", 0}, {"ka", 0}, {"ior", 1}};
  json sun = distant_json({-0.6, 0, 0.8}, 0.8);
  sun["angle"] = 0.2;
  // Lets half through, on the way to the light and not to the eye.
  const json pane = mesh_json({{0.5, -9, 4}, {0.5, 9, 4}, {9, 0, 4}}, {{0, 1, 2}}, glass);
  const double clear = only_color(document(camera_json(), {wall()}, {sun})).x;
  EXPECT_NEAR(only_color(document(camera_json(), {wall(), pane}, {sun})).x, clear / 2, 1e-5);
}

TEST(SoftLight, looks_the_same_at_any_scale) {
  const auto picture = [](double scale) {
    json sky = sky_json(0.5);
    sky["reach"] = 3 * scale;
    json sun = distant_json({-0.5, -1, 0.5}, 0.3);
    sun["angle"] = 0.4;
    return image_of(document(camera_json(24, 18, 1, {0, 2 * scale, -6 * scale}, {0, 0, 0}),
                             {sphere_json({0, 0, 0}, scale, diffuse_material()),
                              plane_json({0, -scale, 0}, {0, 1, 0}, diffuse_material())},
                             {sky, sun, lamp_json({2 * scale, 3 * scale, -scale}, 0.5 * scale)}));
  };
  const Image expected = picture(1);
  for (const int exponent : {-100, 100})
    EXPECT_EQ(picture(std::ldexp(1, exponent)).values, expected.values) << exponent;
}

}  // namespace
}  // namespace raytracer::test

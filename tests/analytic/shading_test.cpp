// Blinn-Phong by hand at one point, the fall-off of point lights, and shadows.
//
// The one pixel's ray goes along +z and meets a plane at (0, 0, 5): N = V = (0, 0, -1).

#include <gtest/gtest.h>

#include <numbers>

#include "engine/materials/blinn_phong/blinn_phong.h"
#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

using std::numbers::pi;

const Vec3 color{0.5, 0.25, 1};

json wall(double ka, double kd, double ks, double shininess) {
  return plane_json({0, 0, 5}, {0, 0, -1},
                    {{"color", vector_json(color)},
                     {"ka", ka},
                     {"kd", kd},
                     {"ks", ks},
                     {"shininess", shininess}});
}

TEST(Shading, adds_ambient_diffuse_and_highlight_each_times_the_color) {
  // L = (0.6, 0, -0.8): N.L = 0.8; H = unit(0.6, 0, -1.8): (H.N)^2 = 0.9, so (H.N)^10 = 0.9^5.
  const Vec3 light_color{1, 0.8, 0.6};
  json text = document(camera_json(), {wall(0.5, 0.4, 0.3, 10)},
                       {distant_json({-0.6, 0, 0.8}, 0.9, light_color)});
  text["ambient"] = 0.3;
  expect_color(text, color * (0.5 * 0.3) +
                         color * light_color * ((0.4 * 0.8 + 0.3 * std::pow(0.9, 5)) * 0.9));
}

TEST(Shading, highlight_of_shininess_zero_is_ks_everywhere) {
  expect_color(document(camera_json(), {wall(0, 0, 0.5, 0)}, {distant_json({-0.6, 0, 0.8})}),
               color * 0.5);
}

TEST(Shading, highlight_of_a_huge_shininess_is_no_nan) {
  expect_color(document(camera_json(), {wall(0, 0, 0.5, 1e300)}, {distant_json({0, 0, 1})}),
               color * 0.5);
  expect_color(document(camera_json(), {wall(0, 0, 0.5, 1e300)}, {distant_json({-0.6, 0, 0.8})}),
               {0, 0, 0});
}

TEST(Shading, zero_to_the_zero_is_one) {
  BlinnPhong material{.color = color, .ka = 0, .kd = 0, .ks = 0.5, .shininess = 0};
  const ArrivingLight light{{1, 0, 0}, 1, {1, 1, 1}};
  const Vec3 normal{0, 1, 0};  // H.N = 0
  EXPECT_EQ(direct_light(material, light, normal, {1, 0, 0}), color * 0.5);
  EXPECT_EQ(direct_light(material, light, normal, {1, -0.5, 0}), color * 0.5);  // H.N < 0
  material.shininess = 1e-3;
  EXPECT_EQ(direct_light(material, light, normal, {1, 0, 0}), Vec3{});
}

TEST(Shading, point_light_without_falloff_is_as_bright_at_any_distance) {
  for (const double away : {1e-6, 0.5, 4.0, 1e6}) {
    json light = point_json({-0.6 * away, 0, 5 - 0.8 * away}, 0.9);
    light["falloff"] = "none";
    expect_color(document(camera_json(), {wall(0, 1, 0, 0)}, {light}), color * (0.9 * 0.8));
  }
}

TEST(Shading, point_light_falls_with_the_square_of_its_distance) {
  for (const double distance_to_light : {0.01, 0.5, 1.0, 2.0, 4.5}) {
    const double intensity = 2 * distance_to_light * distance_to_light;
    expect_color(document(camera_json(), {wall(0, 1, 0, 1)},
                          {point_json({0, 0, 5 - distance_to_light}, intensity)}),
                 color * (2 / (4 * pi)));
  }
}

TEST(Shading, point_light_is_weighted_by_its_angle) {
  // From (3, 0, 1) the distance to (0, 0, 5) is 5 and N.L = 4 / 5.
  expect_color(document(camera_json(), {wall(0, 1, 0, 1)}, {point_json({3, 0, 1}, 100)}),
               color * (100 / (4 * pi * 25) * 0.8));
}

TEST(Shading, distant_light_does_not_depend_on_the_length_of_its_direction) {
  for (const double length_of_direction : {1e-300, 1e-3, 7.0, 1e300})
    expect_color(document(camera_json(), {wall(0, 1, 0, 1)},
                          {distant_json(length_of_direction * Vec3{-0.6, 0, 0.8})}),
                 color * 0.8);
}

TEST(Shading, ambient_counts_once_for_each_visible_light_under_black_shadows_only) {
  json text =
      document(camera_json(), {wall(1, 0, 0, 1)},
               {distant_json({0, 0, 1}), distant_json({1, 0, 1}), distant_json({0, 0, -1})});
  expect_color(text, color * 0.4);  // two of the three are on the visible side
  text["shadows"] = "ambient";
  expect_color(text, color * 0.2);
  text["shadows"] = "off";
  expect_color(text, color * 0.2);
}

TEST(Shading, of_a_sphere_uses_its_normal) {
  // The ray along +z at x = 0 meets the sphere around (0.6, 0, 5), r = 1, at z = 5 - 0.8 with
  // N = (-0.6, 0, -0.8).
  const json text = document(camera_json(), {sphere_json({0.6, 0, 5}, 1, diffuse_material())},
                             {distant_json({0, 0, 1})});
  expect_color(text, {0.8, 0.8, 0.8});
}

TEST(Shading, of_a_mesh_is_the_same_from_both_sides) {
  for (const auto& order : {std::array{0, 1, 2}, std::array{0, 2, 1}})
    expect_color(
        document(camera_json(),
                 {mesh_json({{-9, -9, 5}, {9, -9, 5}, {0, 9, 5}}, {order}, diffuse_material())},
                 {distant_json({-0.6, 0, 0.8})}),
        {0.8, 0.8, 0.8});
}

/// The wall of colour 1 under a light along -x and +z, with a ball on the way to it or not.
json shadow_scene(const char* shadows, bool is_shadowed, const json& light) {
  const Vec3 towards{0.6, 0, -0.8};
  json text = document(camera_json(),
                       {plane_json({0, 0, 5}, {0, 0, -1}, {{"ka", 0.5}, {"kd", 0.5}, {"ks", 0}}),
                        sphere_json(Vec3{0, is_shadowed ? 0.0 : 3.0, 5} + 2.5 * towards, 0.5)},
                       {light});
  text["shadows"] = shadows;
  return text;
}

constexpr double ambient_part = 0.5 * 0.2;
constexpr double direct_part = 0.5 * 0.8;

TEST(Shadow, black_takes_the_ambient_part_too) {
  const json light = distant_json({-0.6, 0, 0.8});
  expect_gray(shadow_scene("black", false, light), ambient_part + direct_part);
  expect_gray(shadow_scene("black", true, light), 0);
}

TEST(Shadow, ambient_leaves_the_ambient_part) {
  const json light = distant_json({-0.6, 0, 0.8});
  expect_gray(shadow_scene("ambient", false, light), ambient_part + direct_part);
  expect_gray(shadow_scene("ambient", true, light), ambient_part);
}

TEST(Shadow, off_leaves_all) {
  const json light = distant_json({-0.6, 0, 0.8});
  expect_gray(shadow_scene("off", false, light), ambient_part + direct_part);
  expect_gray(shadow_scene("off", true, light), ambient_part + direct_part);
}

TEST(Shadow, of_a_point_light_is_cast_by_what_is_nearer_than_the_light_only) {
  const auto light_at = [](double distance_to_light) {
    return point_json(Vec3{0, 0, 5} + distance_to_light * Vec3{0.6, 0, -0.8},
                      4 * pi * distance_to_light * distance_to_light);
  };
  expect_gray(shadow_scene("ambient", true, light_at(5)), ambient_part);
  expect_gray(shadow_scene("ambient", true, light_at(3.01)), ambient_part);
  expect_gray(shadow_scene("ambient", true, light_at(1.99)), ambient_part + direct_part);
  expect_gray(shadow_scene("ambient", true, light_at(2.5)), ambient_part);  // inside the ball
  expect_gray(shadow_scene("ambient", false, light_at(5)), ambient_part + direct_part);
}

TEST(Shadow, is_cast_by_what_is_closed_around_the_light) {
  // Each reaches farther behind the light than before it.
  for (const json& object : {sphere_json({0, 0, 8.9}, 1), cylinder_json({-1, 0, 9}, {1, 0, 9}, 1),
                             cylinder_json({0, 0, 7.9}, {0, 0, 10}, 1),
                             json{{"type", "cone"},
                                  {"from", {0, 0, 7.9}},
                                  {"to", {0, 0, 12}},
                                  {"radius_from", 1},
                                  {"radius_to", 0}},
                             json{{"type", "cone"},
                                  {"from", {-1, 0, 9}},
                                  {"to", {1, 0, 9}},
                                  {"radius_from", 0.5},
                                  {"radius_to", 1.5}}}) {
    for (const char* precision : {"single", "double"}) {
      json text = document(camera_json(24, 18, 1, {0, 0, 7}, {0, 0, 0}),
                           {plane_json({0, 0, 0}, {0, 0, 1}, diffuse_material()), object},
                           {point_json({0, 0, 8.2}, 900)});
      text["render"] = {{"precision", precision}};
      const Image image = image_of(text);
      for (const float value : image.values) EXPECT_EQ(value, 0) << object;
    }
  }
}

TEST(Shadow, is_cast_by_every_kind_of_object) {
  const Vec3 middle = Vec3{0, 0, 5} + 2.5 * Vec3{0.6, 0, -0.8};
  for (const json& object :
       {sphere_json(middle, 0.5), square_json(middle + Vec3{0.3, 0, 0.3}, 0.3, 2),
        square_json(middle + Vec3{0, 0.3, 0.3}, 0.3, 2, "yz"), plane_json(middle, {1, 0, 0}),
        mesh_json({middle + Vec3{0, -1, -1}, middle + Vec3{0, 1, -1}, middle + Vec3{0, 0, 2}},
                  {{0, 1, 2}}),
        json{{"type", "spheres"},
             {"centers", {vector_json({9, 9, 9}), vector_json(middle)}},
             {"radius", {0.1, 0.5}}},
        cylinder_json(middle - Vec3{0, 0.4, 0}, middle + Vec3{0, 0.4, 0}, 0.4),
        cylinder_json(middle - Vec3{0, 0.4, 0}, middle + Vec3{0, 0.4, 0}, 0.4, false),
        cylinder_json(middle, middle + Vec3{0.6, 0, -0.8}, 0.4),
        json{{"type", "cylinders"},
             {"from", {vector_json({9, 9, 9}), vector_json(middle)}},
             {"to", {vector_json({9, 9, 8}), vector_json(middle + Vec3{0.6, 0, -0.8})}},
             {"radius", {0.1, 0.5}}}}) {
    json text = document(camera_json(), {wall(1, 1, 1, 1), object}, {distant_json({-0.6, 0, 0.8})});
    EXPECT_EQ(only_color(text), Vec3{}) << object;
    text["shadows"] = "off";
    EXPECT_GT(only_color(text).x, 0.1);
  }
}

TEST(Shadow, is_not_cast_by_an_open_cylinder_along_the_light) {
  const Vec3 towards{0.6, 0, -0.8};
  const Vec3 middle = Vec3{0, 0, 5} + 2.5 * towards;
  for (const Vec3& aside : {Vec3{}, Vec3{0, 0.2, 0}, Vec3{0.24, -0.1, 0.18}}) {
    for (const json& light :
         {distant_json({-0.6, 0, 0.8}), point_json(middle + 3 * towards + 2 * aside, 500)}) {
      json text = document(camera_json(),
                           {wall(1, 1, 1, 1), cylinder_json(middle + aside - towards,
                                                            middle + aside + towards, 0.4, false)},
                           {light});
      json without = text;
      without["objects"].erase(1);
      EXPECT_LT(distance(only_color(text), only_color(without)), 1e-6);
      text["objects"][1]["caps"] = true;
      EXPECT_EQ(only_color(text), Vec3{});
    }
  }
}

TEST(Shadow, of_a_square_is_cast_by_a_light_along_each_axis) {
  // A coordinate of the way to the light is 0, of either sign: towards the eye, past the square.
  for (const double zero : {0.0, -0.0}) {
    for (const char* axes : {"xz", "xy", "yz"}) {
      for (const Vec3& direction :
           {Vec3{zero, zero, 1}, Vec3{-0.6, zero, 0.8}, Vec3{zero, 0.6, 0.8}}) {
        // A sphere's centre stands on the way, at distance 2.5.
        const Vec3 on_the_way = Vec3{0, 0, 5} - 2.5 * direction;
        const Vec3 corner = axes == std::string_view("xz")   ? Vec3{0.3, 0, 0.3}
                            : axes == std::string_view("xy") ? Vec3{0.3, 0.3, 0}
                                                             : Vec3{0, 0.3, 0.3};
        // The eye looks past the square, at the same point from the side.
        json text = document(camera_json(1, 1, 1, {-6, 5, 1}, {0, 0, 5}),
                             {wall(1, 1, 1, 1), square_json(on_the_way + corner, 0.3, 2, axes)},
                             {distant_json(direction)});
        EXPECT_EQ(only_color(text), Vec3{}) << axes << ' ' << text["lights"];
        text["shadows"] = "off";
        EXPECT_GT(only_color(text).x, 0.1);
      }
    }
  }
}

TEST(Shadow, is_not_cast_by_what_the_light_lies_in) {
  // "Nearer than the light": a light in the ceiling or on a lamp's surface lights the room.
  json text = document(camera_json(64, 48, 1.4, {0.1, 1, -3}, {0, 0, 0}),
                       {plane_json({0, 0, 0}, {0, 1, 0}, diffuse_material()),
                        plane_json({0, 10, 0}, {0, 1, 0}, diffuse_material())},
                       {point_json({0.3, 10, 0.7}, 900)});
  json without_shadows = text;
  without_shadows["shadows"] = "off";
  EXPECT_EQ(count_different(image_of(text), image_of(without_shadows)), 0);
  for (const json& lamp : {sphere_json({0.3, 11.7, 0.7}, 1.7),
                           cylinder_json({-1.7, 11.7, 0.7}, {1.9, 11.7, 0.7}, 1.7)}) {
    text["objects"][1] = without_shadows["objects"][1] = lamp;
    EXPECT_EQ(count_different(image_of(text), image_of(without_shadows)), 0) << lamp;
  }
}

TEST(Shadow, is_not_cast_by_a_plane_along_the_light) {
  const json ball = sphere_json({0, 0, 0}, 1, diffuse_material());
  const struct {
    std::array<double, 3> direction, normal;
  } along[]{{{1, 1, -1}, {0, 1, 1}},
            {{1, 1, 1}, {1, -1, 0}},
            {{1, 1, 1}, {1, 1, -2}},
            {{1, 2, 3}, {1, 1, -1}},
            {{0.3, 0.7, 0}, {-0.7, 0.3, -0.2}}};
  for (const auto& [direction, normal] : along)
    for (const double side : {-7.0, -5.0, 5.0, 7.0}) {
      json text = document(camera_json(20, 16, 0.2, {-3, -3, 3}, {0, 0, 0}), {ball},
                           {distant_json({direction[0], direction[1], direction[2]})});
      for (const char* const precision : {"double", "auto"}) {
        text["render"]["precision"] = precision;
        json with_plane = text;
        with_plane["objects"].push_back(
            plane_json({side * normal[0], side * normal[1], side * normal[2]},
                       {normal[0], normal[1], normal[2]}));
        EXPECT_LE(distance(image_of(with_plane), image_of(text)), 1e-6)
            << json(direction) << json(normal) << side << precision;
      }
    }
}

TEST(Light, along_a_surface_lights_none_of_it) {
  const Vec3 black{};
  json ceiling = document(
      camera_json(48, 36, 1.2, {0.1, 0.3, -1}, {0, 2.7, 0.5}),
      {mesh_json({{-9, 2.7, -9}, {9, 2.7, -9}, {9, 2.7, 9}, {-9, 2.7, 9}}, {{0, 1, 2}, {0, 2, 3}})},
      {point_json({0, 2.7, 0}, 60)});
  expect_exact_color(ceiling, black);
  ceiling["objects"] = {plane_json({0, 2.7, 0}, {0, -1, 0})};
  expect_exact_color(ceiling, black);
  json slope = document(camera_json(30, 20, 0.8, {1, 2, 8}, {0, 0, 0}),
                        {plane_json({0, 0, 0}, {1, 2, 3})}, {distant_json({1, 1, -1})});
  slope["ambient"] = 0.2;
  expect_exact_color(slope, black);
}

TEST(Light, exactly_at_a_surface_lights_nothing_there_and_makes_no_nan) {
  const Image image =
      image_of(document(camera_json(9, 9), {wall(1, 1, 1, 1)}, {point_json({0, 0, 5}, 100)}));
  for (const float value : image.values) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace raytracer::test

// Meshes that their corners' normals and colours shade, against what is known.
//
// A right triangle in the plane z = 5 fills the view of a camera at the origin: where it is met, at
// 5 (x, y, 1), its barycentric coordinates are those of (5 x, 5 y).

#include <gtest/gtest.h>

#include "tests/analytic/expect_color.h"

namespace raytracer::test {
namespace {

constexpr int view_width = 40;
constexpr int view_height = 30;
constexpr double view_fov = 0.6;
const double pixels_at_unit = view_width / (2 * std::tan(view_fov / 2));
const std::vector<Vec3> corner_points{{-4, -4, 5}, {12, -4, 5}, {-4, 12, 5}};

/// Seen from its back, unless it is turned.
json smooth_triangle(const std::vector<Vec3>& normals, const std::vector<Vec3>& colors,
                     const json& material, bool is_turned = false) {
  json mesh{{"type", "mesh"}, {"vertices", json::array()}, {"material", material}};
  for (const Vec3& corner : corner_points) mesh["vertices"].push_back(vector_json(corner));
  for (const Vec3& normal : normals) mesh["normals"].push_back(vector_json(normal));
  for (const Vec3& color : colors) mesh["colors"].push_back(vector_json(color));
  mesh["triangles"] = {is_turned ? std::array{0, 2, 1} : std::array{0, 1, 2}};
  return mesh;
}

/// Expects each pixel to be expected(b, c) of the weights of the second corner and the third.
template <typename Expected>
void expect_by_weights(json text, const Expected& expected) {
  for (const auto& [precision, tolerance] : tolerances) {
    text["render"]["precision"] = precision;
    const Image image = image_of(text);
    for (int y = 0; y < view_height; ++y)
      for (int x = 0; x < view_width; ++x) {
        const double px = 5 * (x + 0.5 - view_width / 2.0) / pixels_at_unit;
        const double py = 5 * (view_height / 2.0 - y - 0.5) / pixels_at_unit;
        const Vec3 wanted = expected((px + 4) / 16, (py + 4) / 16);
        ASSERT_LE(distance(color_at(image, x, y), wanted), tolerance)
            << precision << ' ' << x << ' ' << y;
      }
  }
}

json in_view(const std::vector<json>& objects, const std::vector<json>& lights) {
  json text = document(camera_json(view_width, view_height, view_fov), objects, lights);
  text["ambient"] = 1;
  return text;
}

TEST(SmoothMesh, has_colors_between_those_of_its_corners) {
  const std::vector<Vec3> colors{{1, 0.2, 0}, {0, 0.6, 0.5}, {0.25, 1, 1}};
  expect_by_weights(
      in_view({smooth_triangle({}, colors, constant_material({0.3, 0.3, 0.3}))},
              {distant_json({0, 0, 1})}),
      [&](double b, double c) { return (1 - b - c) * colors[0] + b * colors[1] + c * colors[2]; });
}

TEST(SmoothMesh, is_shaded_by_the_normals_between_those_of_its_corners) {
  const std::vector<Vec3> normals{{0.5, 0, -1}, {-0.4, 0.3, -1}, {0, -2, -2}};
  const Vec3 light = -unit(Vec3{0.2, 0.1, 1});
  for (const bool is_turned : {false, true}) {
    // From the back the normals are turned with the triangle's own.
    std::vector<Vec3> given = normals;
    if (!is_turned)
      for (Vec3& normal : given) normal = -1.0 * normal;
    expect_by_weights(in_view({smooth_triangle(given, {}, diffuse_material(), is_turned)},
                              {distant_json({0.2, 0.1, 1}, 0.9)}),
                      [&](double b, double c) {
                        const Vec3 normal =
                            unit((1 - b - c) * normals[0] + b * normals[1] + c * normals[2]);
                        const double gray = 0.9 * std::max(0.0, dot(normal, light));
                        return Vec3{gray, gray, gray};
                      });
  }
}

TEST(SmoothMesh, is_dark_where_its_surface_turns_away_from_the_light) {
  // The normals face a light behind the triangle.
  const std::vector<Vec3> normals(3, Vec3{-1, 0, -0.05});
  expect_exact_color(in_view({smooth_triangle(normals, {}, diffuse_material(), true)},
                             {distant_json({1, 0, -0.01})}),
                     {0, 0, 0});
}

TEST(SmoothMesh, mirrors_by_the_normal_that_shades) {
  // All normals lean by 30 degrees to the right: the way there leads to the wall at x = 20.
  const json mirror{{"ka", 0}, {"kd", 0}, {"ks", 0}, {"reflectivity", 0.5}};
  const std::vector<Vec3> leaning(3, Vec3{0.5, 0, -std::sqrt(0.75)});
  const json wall = plane_json({20, 0, 0}, {-1, 0, 0}, constant_material({1, 0, 1}));
  json text =
      in_view({smooth_triangle(leaning, {}, mirror, true), wall}, {distant_json({1, 0, 0.1})});
  text["background"] = {0, 1, 0};
  expect_color(text, {0.5, 0, 0.5});
  // Below the surface no mirror sends a ray: then its own normal counts.
  const std::vector<Vec3> flat(3, Vec3{1, 0, -0.05});
  text["objects"][0] = smooth_triangle(flat, {}, mirror, true);
  const Image image = image_of(text);
  EXPECT_EQ(color_at(image, view_width / 2 - 1, view_height / 2), (Vec3{0, 0.5, 0}));
}

TEST(SmoothMesh, without_a_normal_at_a_point_takes_the_triangles_own) {
  // Opposite ones cancel in the middle of a side, and nowhere is a colour no number.
  const std::vector<Vec3> normals{{1, 0, 0}, {-1, 0, 0}, {0, 0, -1}};
  json text =
      in_view({smooth_triangle(normals, {}, diffuse_material(), true)}, {distant_json({0, 0, 1})});
  const Image image = image_of(text);
  for (const float value : image.values) EXPECT_TRUE(value >= 0 && value <= 1);
}

}  // namespace
}  // namespace raytracer::test

// Fine meshes: rays and shadows pass through corners that triangles share, at
// coordinates that no number of two holds exactly. Nothing slips through.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr int side_px = 96;
constexpr double pixel = 0.003;
const Vec3 middle{0.1, 0.2, 0.3};

/// Across the z-axis, wider than the view, with a corner in the middle of each pixel of `pixel`'s
/// width, or of each fourth in a row.
json sheet(int pixels_apart) {
  const int corners = side_px / pixels_apart + 9;
  const double pitch = pixel * pixels_apart;
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < corners; ++i)
    for (int k = 0; k < corners; ++k) {
      const double half = 0.5 * (corners - 1);
      vertices.push_back(
          middle + Vec3{(i - half) * pitch - 0.5 * pixel, (k - half) * pitch - 0.5 * pixel, 0});
      if (i == 0 || k == 0) continue;
      const int last = i * corners + k;
      triangles.push_back({last, last - 1, last - corners});
      triangles.push_back({last - corners - 1, last - 1, last - corners});
    }
  return mesh_json(vertices, triangles, constant_material({1, 1, 1}));
}

/// Looks along the z-axis at what is `distance` away, where its pixels are `width` wide.
json camera(const Vec3& target, double distance, double width) {
  return camera_json(side_px, side_px, 2 * std::atan(0.5 * side_px * width / distance),
                     target - Vec3{0, 0, distance}, target);
}

void expect_lit(json text, int count) {
  for (const char* precision : {"auto", "single", "double"}) {
    text["render"] = {{"precision", precision}};
    EXPECT_EQ(count_lit(image_of(text)), count) << precision;
  }
}

TEST(FineMesh, hides_what_is_behind_it) {
  for (const int pixels_apart : {1, 4})
    for (const double distance : {0.7, 10.1, 130.0})
      expect_lit(document(camera(middle, distance, pixel), {sheet(pixels_apart)},
                          {distant_json({0, 0, 1})}),
                 side_px * side_px);
}

/// Seen from between the sheet and the wall that its shadow falls on.
TEST(FineMesh, hides_lights) {
  const Vec3 on_wall = middle + Vec3{0, 0, 10.1};
  for (const int pixels_apart : {1, 4}) {
    const std::vector<json> objects{sheet(pixels_apart), plane_json(on_wall, {0, 0, -1})};
    expect_lit(document(camera(on_wall, 9.7, pixel), objects, {distant_json({0, 0, 1})}), 0);
    for (const double height : {1.7, 300.0}) {
      const double enlarged = (height + 10.1) / height;
      expect_lit(document(camera(on_wall, 9.7, pixel * enlarged), objects,
                          {point_json(middle - Vec3{0, 0, height}, 1e6)}),
                 0);
    }
  }
}

}  // namespace
}  // namespace raytracer::test

// Triangles fill a polygon exactly: their areas have its sign and sum, and each side is a side of
// the polygon or of two triangles.
#include "client/formats/triangulate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace raytracer::test {
namespace {

using client::triangulate;
using client::Triangulation;
using Corner = std::array<double, 3>;
using Corners = std::vector<Corner>;

/// Twice the area, with the sense of rotation seen along z.
double doubled_area(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double doubled_area(const Corners& polygon) {
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area += doubled_area(polygon[0], polygon[i - 1], polygon[i]);
  return area;
}

/// `polygon` is in the plane of x and y.
void expect_filled(const Corners& polygon) {
  const Triangulation filled = triangulate(polygon);
  EXPECT_FALSE(filled.crosses_itself);
  const double whole = doubled_area(polygon);
  double sum = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& triangle : filled.triangles) {
    const double area =
        doubled_area(polygon[triangle[0]], polygon[triangle[1]], polygon[triangle[2]]);
    EXPECT_GE(area * whole, 0);
    sum += area;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = triangle[i];
      const auto to = triangle[(i + 1) % 3];
      ++sides[{from, to}];
      --sides[{to, from}];
    }
  }
  EXPECT_NEAR(sum, whole, 1e-9 * std::abs(whole));
  for (const auto& [side, count] : sides) {
    const bool is_outer = (side.first + 1) % polygon.size() == side.second;
    const bool is_outer_reversed = (side.second + 1) % polygon.size() == side.first;
    EXPECT_EQ(count, is_outer ? 1 : is_outer_reversed ? -1 : 0);
  }
}

/// Corners at random distances around the origin: concave as a rule, and never crossing.
Corners star(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> distance(0.1, 1);
  Corners corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double radius = distance(random);
    corners.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return corners;
}

TEST(Triangulate, convex_polygons_are_filled) {
  for (int count = 3; count < 40; ++count) {
    Corners corners;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      corners.push_back({std::cos(angle), std::sin(angle), 0});
    }
    expect_filled(corners);
    EXPECT_EQ(triangulate(corners).triangles.size(), corners.size() - 2);
  }
}

TEST(Triangulate, concave_polygons_of_both_senses_are_filled) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    Corners corners = star(3 + round % 60, random);
    if (triangulate(corners).triangles.empty()) continue;
    expect_filled(corners);
    expect_filled({corners.rbegin(), corners.rend()});
  }
}

TEST(Triangulate, comb_is_filled) {
  Corners corners;
  for (int i = 0; i < 50; ++i) {
    corners.push_back({2.0 * i, 0, 0});
    corners.push_back({2.0 * i + 1, 100, 0});
  }
  corners.push_back({100, -1, 0});
  corners.push_back({0, -1, 0});
  expect_filled({corners.rbegin(), corners.rend()});
}

TEST(Triangulate, corners_on_a_line_and_in_one_place_do_no_harm) {
  expect_filled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  double sum = 0;
  const Corners closed{{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  for (const auto& [a, b, c] : triangulate(closed).triangles)
    sum += doubled_area(closed[a], closed[b], closed[c]);
  EXPECT_EQ(sum, 8);
}

/// A square with a square hole, to which a slit leads.
TEST(Triangulate, hole_stays_empty) {
  const Corners corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                        {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  const Triangulation filled = triangulate(corners);
  EXPECT_FALSE(filled.crosses_itself);
  double sum = 0;
  for (const auto& [a, b, c] : filled.triangles) {
    EXPECT_GT(doubled_area(corners[a], corners[b], corners[c]), 0);
    sum += doubled_area(corners[a], corners[b], corners[c]);
    const double x = (corners[a][0] + corners[b][0] + corners[c][0]) / 3;
    const double y = (corners[a][1] + corners[b][1] + corners[c][1]) / 3;
    EXPECT_FALSE(x > 1 && x < 3 && y > 1 && y < 3) << x << ", " << y;
  }
  EXPECT_EQ(sum, 2 * (16 - 4));
}

/// The same corners make the same triangles wherever they lie, at any scale.
TEST(Triangulate, plane_and_scale_do_not_matter) {
  std::mt19937 random(8);
  const Corners flat = star(25, random);
  const auto expected = triangulate(flat).triangles;
  for (const double scale : {1.0, 0x1p-1000, 0x1p1000})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Corners turned;
      for (const Corner& corner : flat) {
        Corner& place = turned.emplace_back();
        place[(axis + 1) % 3] = scale * corner[0];
        place[(axis + 2) % 3] = scale * corner[1];
        place[axis] = scale;
      }
      EXPECT_EQ(triangulate(turned).triangles, expected) << scale << ' ' << axis;
    }
}

TEST(Triangulate, polygon_without_area_has_no_triangles) {
  for (const Corners& corners : {Corners{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}},
                                 Corners{{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}},
                                 Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}}})
    EXPECT_TRUE(triangulate(corners).triangles.empty());
}

TEST(Triangulate, sides_that_cross_are_noticed) {
  EXPECT_TRUE(
      triangulate({{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}}).crosses_itself);
  EXPECT_TRUE(triangulate({{0, 0, 0}, {3, 2, 0}, {3, 0, 0}, {0, 1, 0}}).crosses_itself);
}

/// The seconds that it takes.
double time_to_fill(const Corners& corners) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(triangulate(corners).triangles.size(), corners.size() - 2);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Triangulate, star_of_20000_corners_is_filled_in_time) {
  std::mt19937 random(9);
  EXPECT_LT(time_to_fill(star(20'000, random)), 10);
}

TEST(Triangulate, polygon_that_crosses_itself_everywhere_takes_no_longer) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> anywhere(0, 1);
  Corners corners(20'000);
  for (Corner& corner : corners) corner = {anywhere(random), anywhere(random), 0};
  EXPECT_LT(time_to_fill(corners), 10);
}

}  // namespace
}  // namespace raytracer::test

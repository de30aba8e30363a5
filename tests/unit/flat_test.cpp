// Planes and triangles: both sides, no gaps, and no shadow of a surface on itself.

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

TEST(Plane, is_hit_from_both_sides_with_its_normal_towards_the_ray) {
  const PackedPlane plane{{7, 2, -3}, {0, 1, 0}, {}};
  const auto above = intersect(ray_from({0, 5, 0}, {0, -1, 0}), plane);
  ASSERT_TRUE(above);
  EXPECT_EQ(above->t, 3);
  EXPECT_EQ(above->point.normal, (Vec3{0, 1, 0}));
  const auto below = intersect(ray_from({0, -5, 0}, {0, 1, 0}), plane);
  ASSERT_TRUE(below);
  EXPECT_EQ(below->t, 7);
  EXPECT_EQ(below->point.normal, (Vec3{0, -1, 0}));
}

TEST(Plane, is_not_hit_behind_nor_along_nor_from_within) {
  const PackedPlane plane{{0, 0, 0}, {0, 1, 0}, {}};
  EXPECT_FALSE(intersect(ray_from({0, 5, 0}, {0, 1, 0}), plane));
  EXPECT_FALSE(intersect(ray_from({0, 5, 0}, {1, 0, 0}), plane));
  EXPECT_FALSE(intersect(ray_from({0, 0, 0}, {1, 0, 0}), plane));
  EXPECT_FALSE(intersect(ray_from({0, 0, 0}, {1, -1, 0}), plane));
  EXPECT_FALSE(intersect(ray_from({0, 0, 0}, {1, 1, 0}), plane));
}

TEST(Triangle, is_hit_from_both_sides_with_its_normal_towards_the_ray) {
  const PackedTriangle triangle = packed_triangle({0, 0, 5}, {4, 0, 5}, {0, 4, 5}, {});
  for (const double side : {-1.0, 1.0}) {
    const auto found = intersect(ray_from({1, 1, 5 + side * 3}, {0, 0, -side}), triangle);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->t, 3);
    EXPECT_EQ(found->point.normal, (Vec3{0, 0, side}));
    EXPECT_FALSE(intersect(ray_from({1, 1, 5 + side * 3}, {0, 0, side}), triangle));
  }
}

TEST(Triangle, is_hit_inside_and_not_outside) {
  const PackedTriangle triangle = packed_triangle({0, 0, 5}, {4, 0, 5}, {0, 4, 5}, {});
  for (int i = -20; i <= 60; ++i) {
    for (int k = -20; k <= 60; ++k) {
      const double x = i * 0.1 + 0.05;  // never on an edge
      const double y = k * 0.1 + 0.02;
      const bool inside = x > 0 && y > 0 && x + y < 4;
      EXPECT_EQ(intersect(ray_from({x, y, 0}, {0, 0, 1}), triangle).has_value(), inside)
          << x << ' ' << y;
    }
  }
}

TEST(Triangle, in_whose_plane_the_ray_runs_is_not_hit) {
  const PackedTriangle triangle = packed_triangle({0, 0, 5}, {4, 0, 5}, {0, 4, 5}, {});
  EXPECT_FALSE(intersect(ray_from({-1, 1, 5}, {1, 0, 0}), triangle));
  EXPECT_FALSE(intersect(ray_from({-1, 0, 5}, {1, 0, 0}), triangle));
}

/// A rough sheet over [-1, 1]^2 of side * side * 2 triangles with shared corners.
struct Sheet {
  std::vector<Vec3> corners;
  std::vector<PackedTriangle> triangles;
  std::vector<std::pair<Vec3, Vec3>> inner_edges;

  template <typename Height>
  Sheet(int side, double jitter, Random& random, Height height) {
    for (int i = 0; i <= side; ++i) {
      for (int k = 0; k <= side; ++k) {
        const bool is_border = i == 0 || k == 0 || i == side || k == side;
        const double shift = is_border ? 0 : jitter / side;
        const double x = 2.0 * i / side - 1 + random.between(-shift, shift);
        const double y = 2.0 * k / side - 1 + random.between(-shift, shift);
        corners.push_back({x, y, height(x, y)});
      }
    }
    const auto corner = [&](int i, int k) {
      return corners.at(static_cast<std::size_t>(i) * static_cast<std::size_t>(side + 1) +
                        static_cast<std::size_t>(k));
    };
    for (int i = 0; i < side; ++i) {
      for (int k = 0; k < side; ++k) {
        add(corner(i, k), corner(i + 1, k), corner(i + 1, k + 1));
        add(corner(i + 1, k + 1), corner(i, k + 1), corner(i, k));
        inner_edges.emplace_back(corner(i, k), corner(i + 1, k + 1));
        if (k > 0) inner_edges.emplace_back(corner(i, k), corner(i + 1, k));
        if (i > 0) inner_edges.emplace_back(corner(i, k), corner(i, k + 1));
      }
    }
  }

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    triangles.push_back(packed_triangle(a, b, c, {0, triangles.size()}));
  }

  bool is_hit_by(const Ray& ray) const {
    AnyHit query(ray, 1e30);
    for (const PackedTriangle& triangle : triangles) query.add(triangle);
    return query.found();
  }
};

TEST(Mesh, lets_no_ray_through_its_edges_or_corners) {
  Random random(6);
  const Sheet sheet(6, 0.3, random, [&](double, double) { return random.between(-0.03, 0.03); });
  for (int round = 0; round < 200; ++round) {
    const Vec3 eye = random.point(-0.3, 0.3) + Vec3{0, 0, 1 + std::pow(10, random.between(-1, 3))};
    for (const auto& [a, b] : sheet.inner_edges) {
      for (int i = 1; i < 10; ++i) {
        const double share = random.between(0, 1);
        EXPECT_TRUE(sheet.is_hit_by(ray_towards(eye, a * share + b * (1 - share))));
      }
    }
    for (const Vec3& corner : sheet.corners) {
      if (std::abs(corner.x) == 1 || std::abs(corner.y) == 1) continue;
      EXPECT_TRUE(sheet.is_hit_by(ray_towards(eye, corner)))
          << eye.x << ' ' << eye.y << ' ' << eye.z;
    }
  }
}

TEST(Mesh, lets_no_axis_parallel_ray_through_the_seams_of_a_grid) {
  Random random(7);
  const Sheet sheet(8, 0, random, [](double, double) { return 0.25; });
  for (int i = -63; i <= 63; ++i)
    for (int k = -63; k <= 63; ++k)
      EXPECT_TRUE(sheet.is_hit_by(ray_from({i / 64.0, k / 64.0, 3}, {0, 0, -1}))) << i << ' ' << k;
}

TEST(Mesh, whose_triangles_lie_in_one_plane_does_not_shadow_itself) {
  Random random(8);
  for (const double tilt : {0.0, 0.1, 0.7318, 12.3}) {
    const Sheet sheet(6, 0.45, random,
                      [&](double x, double y) { return tilt * x + 0.3 * tilt * y + 0.1; });
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = ray_towards({0.3, -0.4, i % 2 == 0 ? 30.0 : -30.0},
                                  {random.between(-1, 1), random.between(-1, 1), 0.1});
      NearestHit query(ray);
      for (const PackedTriangle& triangle : sheet.triangles) query.add(triangle);
      if (!query.found()) continue;
      Vec3 direction = random.direction();
      if (dot(direction, query.point().normal) < 0) direction = -direction;
      EXPECT_FALSE(sheet.is_hit_by(ray_leaving(query.point(), direction)));
      // Nearly along the surface it is hardest.
      const Vec3 grazing =
          unit(direction - dot(direction, query.point().normal) * query.point().normal) +
          1e-9 * query.point().normal;
      EXPECT_FALSE(sheet.is_hit_by(ray_leaving(query.point(), grazing)));
    }
  }
}

TEST(Mesh, of_a_sliver_does_not_shadow_itself) {
  Random random(9);
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    const PackedTriangle sliver =
        packed_triangle({-0.9, 0.1, 0.2}, {0.8, 0.3, 0.4}, {-0.05, 0.2 + width, 0.3}, {});
    for (int i = 0; i < 1000; ++i) {
      const double share = random.between(0.01, 0.99);
      const Vec3 on_edge = sliver.vertices[0] * share + sliver.vertices[1] * (1 - share);
      const Ray ray = ray_towards({0.1, 0.2, 9}, on_edge * 0.5 + sliver.vertices[2] * 0.5);
      NearestHit query(ray);
      query.add(sliver);
      if (!query.found()) continue;
      Vec3 direction = random.direction();
      if (dot(direction, query.point().normal) < 0) direction = -direction;
      EXPECT_FALSE(intersect(ray_leaving(query.point(), direction), sliver));
    }
  }
}

TEST(Plane, and_a_mesh_in_it_do_not_shadow_each_other) {
  Random random(10);
  const auto height = [](double x, double y) { return 0.37 * x - 0.21 * y + 0.1; };
  const Sheet sheet(4, 0.4, random, height);
  const PackedPlane plane{{0, 0, 0.1}, unit({-0.37, 0.21, 1}), {1, 0}};
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = ray_towards({0.3, -0.4, 30}, {random.between(-2, 2), random.between(-2, 2), 0});
    NearestHit query(ray);
    for (const PackedTriangle& triangle : sheet.triangles) query.add(triangle);
    query.add(plane);
    ASSERT_TRUE(query.found());
    Vec3 direction = random.direction();
    if (dot(direction, query.point().normal) < 0) direction = -direction;
    const Ray leaving = ray_leaving(query.point(), direction);
    EXPECT_FALSE(sheet.is_hit_by(leaving));
    EXPECT_FALSE(intersect(leaving, plane));
  }
}

TEST(Mesh, casts_its_shadow_on_what_is_behind_it) {
  Random random(11);
  const Sheet sheet(6, 0.3, random, [](double x, double y) { return 0.1 * x * y; });
  const PackedPlane floor{{0, 0, -2}, {0, 0, 1}, {1, 0}};
  for (int i = 0; i < 1000; ++i) {
    const Ray ray =
        ray_towards({5, 0, 3}, {random.between(-0.9, 0.9), random.between(-0.9, 0.9), -2});
    NearestHit query(ray);
    query.add(floor);
    ASSERT_TRUE(query.found());
    EXPECT_TRUE(sheet.is_hit_by(ray_leaving(query.point(), {0, 0, 1})));
    EXPECT_FALSE(sheet.is_hit_by(ray_leaving(query.point(), {1, 0, 1e-3})));
  }
}

}  // namespace
}  // namespace raytracer::test

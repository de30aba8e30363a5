// Ray and cylinder: every case, closed and open, from outside, inside and on it.
//
// A ray that leaves no surface begins at the eye, which is the origin here.

#include "engine/objects/cylinder/cylinder.h"

#include <gtest/gtest.h>

#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

constexpr bool closed = true;
constexpr bool open = false;

PackedCylinder packed(const Vec3& from, const Vec3& to, double radius, bool caps) {
  const Frame frame;
  LargeArray<PackedCylinder> primitives;
  double lost = 0;
  Packing<PackedCylinder> packing{frame, nullptr, 0, primitives, lost};
  pack(Cylinder{from, to, radius, caps}, packing);
  EXPECT_EQ(lost, 0);
  return primitives.at(0);
}

std::optional<SurfaceHit> seen(const Vec3& direction, const PackedCylinder& cylinder) {
  return intersect(ray_from({}, direction), cylinder);
}

/// Across the axis, from it to the point.
double distance_to_axis(const PackedCylinder& c, const Vec3& point) {
  return length(cross(point - c.foot, c.axis));
}

/// What leaves the point to the side that it was seen from.
Ray leaving_at_random(const SurfacePoint& point, Random& random) {
  const Vec3 direction = random.direction();
  return ray_leaving(point, dot(direction, point.normal) < 0 ? -direction : direction);
}

/// A cylinder of any size and direction, seen from outside of it.
PackedCylinder random_cylinder(Random& random, bool caps) {
  const double size = std::abs(random.magnitude(-8, 0));
  const Vec3 middle = random.between(3, 6) * size * random.direction();
  const Vec3 half = random.between(0.05, 1.5) * size * random.direction();
  return packed(middle - half, middle + half, size * random.between(0.05, 1), caps);
}

/// A point of the closed cylinder's inside.
Vec3 point_within(const PackedCylinder& c, Random& random, double share_of_radius = 0.9) {
  const double along = c.low + (c.high - c.low) * random.between(0.05, 0.95);
  const Vec3 across = unit(cross(c.axis, random.direction()));
  return c.foot + along * c.axis + share_of_radius * c.radius * across;
}

TEST(Cylinder, is_met_at_its_near_side_from_outside) {
  for (const bool caps : {closed, open}) {
    const auto hit = seen({0, 0, 1}, packed({0, -1, 5}, {0, 3, 5}, 2, caps));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 3);
    EXPECT_EQ(hit->point.normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(hit->point.side, SurfacePoint::Side::round_outside);
    EXPECT_EQ(hit->point.point(), (Vec3{0, 0, 3}));
  }
}

TEST(Cylinder, is_met_at_the_cap_that_faces_the_eye) {
  for (const bool turned : {false, true}) {
    const Vec3 near{0.5, 0.25, 5};
    const Vec3 far{0.5, 0.25, 9};
    const auto hit = seen({0, 0, 1}, packed(turned ? far : near, turned ? near : far, 2, closed));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 5);
    EXPECT_EQ(hit->point.normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(hit->point.side, SurfacePoint::Side::flat);
  }
}

TEST(Cylinder, that_is_open_is_met_at_its_far_wall_through_its_end) {
  // Into the end at z = 2, to the wall at x = 1: at z = 4.
  const auto hit = seen({1, 0, 4}, packed({0, 0, 2}, {0, 0, 9}, 1, open));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, std::sqrt(17.0), 1e-15);
  EXPECT_EQ(hit->point.side, SurfacePoint::Side::round_inside);
  EXPECT_LT(max_abs(hit->point.normal - Vec3{-1, 0, 0}), 1e-15);
  EXPECT_FALSE(seen({1, 0, 9.1}, packed({0, 0, 2}, {0, 0, 9}, 1, open))) << "through both ends";
}

TEST(Cylinder, is_met_along_its_axis_at_its_cap_only) {
  for (const double aside : {0.0, 0.5, 0.999999}) {
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, unit(Vec3{1, 2, 3})}) {
      const Vec3 off = aside * unit(cross(axis, {0.3, 0.7, -0.2}));
      const auto hit = seen(axis, packed(off + 2 * axis, off + 7 * axis, 1, closed));
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->t, 2, 1e-14);
      EXPECT_LT(max_abs(hit->point.normal + axis), 1e-15);
      EXPECT_FALSE(seen(-axis, packed(off + 2 * axis, off + 7 * axis, 1, closed)));
    }
    const PackedCylinder tube = packed({aside, 0, 2}, {aside, 0, 7}, 1, open);
    EXPECT_FALSE(seen({0, 0, 1}, tube)) << "through the open tube";
    EXPECT_FALSE(seen({0, 0, -1}, tube));
  }
  EXPECT_FALSE(seen({0, 0, 1}, packed({1.000001, 0, 2}, {1.000001, 0, 7}, 1, closed)));
}

TEST(Cylinder, is_met_across_its_axis_between_its_ends_only) {
  for (const bool caps : {closed, open}) {
    EXPECT_TRUE(seen({0, 0, 1}, packed({0, -1e-9, 5}, {0, 3, 5}, 2, caps)));
    EXPECT_FALSE(seen({0, 0, 1}, packed({0, 1e-9, 5}, {0, 3, 5}, 2, caps)));
    EXPECT_FALSE(seen({0, 0, 1}, packed({0, -3, 5}, {0, -1e-9, 5}, 2, caps)));
  }
}

TEST(Cylinder, behind_or_beside_is_not_met) {
  for (const bool caps : {closed, open}) {
    EXPECT_FALSE(seen({0, 0, -1}, packed({0, -1, 5}, {0, 3, 5}, 2, caps)));
    EXPECT_FALSE(seen({0, 0, 1}, packed({2.0000001, -1, 5}, {2.0000001, 3, 5}, 2, caps)));
    EXPECT_TRUE(seen({0, 0, 1}, packed({1.9999999, -1, 5}, {1.9999999, 3, 5}, 2, caps)));
  }
}

TEST(Cylinder, around_the_eye_is_met_from_inside) {
  for (const bool caps : {closed, open}) {
    const PackedCylinder around = packed({0, -2, 0.5}, {0, 3, 0.5}, 1, caps);
    const auto wall = seen({0, 0, 1}, around);
    ASSERT_TRUE(wall);
    EXPECT_EQ(wall->t, 1.5);
    EXPECT_EQ(wall->point.normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(wall->point.side, SurfacePoint::Side::round_inside);
    EXPECT_EQ(seen({0, 0, -1}, around)->t, 0.5);
    EXPECT_EQ(seen({0, 1, 0}, around).has_value(), caps);
    EXPECT_EQ(seen({0, -1, 0}, around).has_value(), caps);
    if (!caps) continue;
    EXPECT_EQ(seen({0, 1, 0}, around)->t, 3);
    EXPECT_EQ(seen({0, 1, 0}, around)->point.normal, (Vec3{0, -1, 0}));
    EXPECT_EQ(seen({0, -1, 0}, around)->t, 2);
    EXPECT_EQ(seen({0, -1, 0}, around)->point.normal, (Vec3{0, 1, 0}));
  }
}

TEST(Cylinder, that_the_eye_is_on_is_met_on_its_other_side_only) {
  for (const bool caps : {closed, open}) {
    const PackedCylinder touched = packed({0, -1, 2}, {0, 3, 2}, 2, caps);
    const auto inwards = seen({0, 0, 1}, touched);
    ASSERT_TRUE(inwards);
    EXPECT_EQ(inwards->t, 4);
    EXPECT_EQ(inwards->point.side, SurfacePoint::Side::round_inside);
    EXPECT_FALSE(seen({0, 0, -1}, touched));
    EXPECT_FALSE(seen({0, 0.5, -1}, touched));
    EXPECT_FALSE(seen({1, 0, 0}, touched));
  }
}

TEST(Cylinder, that_is_closed_has_no_hole_at_its_rims) {
  Random random(61);
  for (int i = 0; i < 20'000; ++i) {
    const PackedCylinder c = random_cylinder(random, closed);
    // Rays through the solid, as near to a rim as rounding leaves any of it.
    const bool is_to = i % 2 == 0;
    const Vec3 across = unit(cross(c.axis, random.direction()));
    const double inward = (is_to ? -1e-6 : 1e-6) * c.radius;
    const Vec3 target = c.end(is_to) + inward * c.axis + (1 - 1e-6) * c.radius * across;
    const auto hit = seen(target, c);
    ASSERT_TRUE(hit) << i;
    const Vec3 point = hit->point.point();
    const double rounding = 1e-14 * length(point);
    EXPECT_LE(distance_to_axis(c, point), c.radius + rounding);
    EXPECT_LE(dot(point - c.end(true), c.axis), rounding);
    EXPECT_GE(dot(point - c.end(false), c.axis), -rounding);
  }
}

TEST(Cylinder, at_its_rim_is_met_at_it_or_not_at_all) {
  Random random(62);
  int met = 0;
  for (int i = 0; i < 20'000; ++i) {
    const PackedCylinder c = random_cylinder(random, i % 3 != 0);
    const Vec3 across = unit(cross(c.axis, random.direction()));
    const auto hit = seen(c.end(i % 2 == 0) + c.radius * across, c);
    if (!hit) continue;
    ++met;
    const Vec3 point = hit->point.point();
    const double rounding = 1e-14 * length(point);
    EXPECT_LE(distance_to_axis(c, point), c.radius + rounding);
    EXPECT_LE(std::abs(length(hit->point.normal) - 1), 1e-15);
    EXPECT_LE(dot(hit->point.normal, point), 1e-14 * length(point)) << "away from the eye";
  }
  EXPECT_GT(met, 5000);
}

TEST(Cylinder, that_is_closed_is_met_from_inside_in_every_direction) {
  Random random(63);
  for (int i = 0; i < 20'000; ++i) {
    const double radius = random.between(0.1, 2);
    const Vec3 axis = random.direction();
    const Vec3 aside = random.between(0, 0.99) * radius * unit(cross(axis, random.direction()));
    const PackedCylinder c = packed(aside - random.between(0.01, 3) * axis,
                                    aside + random.between(0.01, 3) * axis, radius, closed);
    const Vec3 across = unit(cross(c.axis, random.direction()));
    const Vec3 rim = c.end(i % 2 == 0) + c.radius * across;
    for (const Vec3& direction : {random.direction(), rim}) {
      const auto hit = seen(direction, c);
      ASSERT_TRUE(hit) << i;
      EXPECT_LE(distance_to_axis(c, hit->point.point()), radius * (1 + 1e-14));
    }
  }
}

TEST(Cylinder, that_a_ray_leaves_outwards_is_not_met_again) {
  Random random(64);
  for (int i = 0; i < 40'000; ++i) {
    const PackedCylinder c = random_cylinder(random, i % 2 == 0);
    const auto hit = seen(point_within(c, random, random.between(0, 0.999999)), c);
    if (!hit) continue;  // through an open one
    if (hit->point.side == SurfacePoint::Side::round_inside) continue;
    const Ray leaving = leaving_at_random(hit->point, random);
    EXPECT_FALSE(intersect(leaving, c)) << i;
  }
}

TEST(Cylinder, that_is_closed_keeps_what_leaves_its_inside) {
  Random random(65);
  for (int i = 0; i < 500; ++i) {
    const Vec3 half = random.between(0.05, 2) * random.direction();
    const PackedCylinder c = packed(-half, half, random.between(0.1, 1), closed);
    auto hit = seen(random.direction(), c);
    for (int bounce = 0; bounce < 40; ++bounce) {
      ASSERT_TRUE(hit) << i << ' ' << bounce;
      const Vec3 point = hit->point.point();
      ASSERT_LE(distance_to_axis(c, point), c.radius * (1 + 1e-12)) << i << ' ' << bounce;
      ASSERT_LE(dot(point - c.end(true), c.axis), 1e-12) << i << ' ' << bounce;
      ASSERT_GE(dot(point - c.end(false), c.axis), -1e-12) << i << ' ' << bounce;
      hit = intersect(leaving_at_random(hit->point, random), c);
    }
  }
}

TEST(Cylinder, has_its_other_wall_two_radii_away) {
  for (const bool caps : {closed, open}) {
    for (const double radius : {0.25, 1.0, 0.3, 1e-6}) {
      const PackedCylinder c = packed({0, 0, -2}, {0, 0, 2}, radius, caps);
      const auto wall = seen({1, 0, 0}, c);
      ASSERT_TRUE(wall);
      EXPECT_EQ(wall->t, radius);
      const auto other = intersect(ray_leaving(wall->point, {-1, 0, 0}), c);
      ASSERT_TRUE(other);
      EXPECT_EQ(other->t, 2 * radius);
      EXPECT_EQ(other->point.normal, (Vec3{1, 0, 0}));
      // Aslant by 45 degrees: the chord is sqrt(2) radii across the axis.
      const auto aslant = intersect(ray_leaving(wall->point, {-1, 1, 0}), c);
      ASSERT_TRUE(aslant);
      EXPECT_NEAR(aslant->t / radius, std::numbers::sqrt2, 1e-15);
    }
  }
}

TEST(Cylinder, that_is_open_lets_out_what_leaves_its_inside_beyond_its_end) {
  const auto next = [](double to, double slope, bool caps) {
    const PackedCylinder c = packed({0, 0, -2}, {0, 0, to}, 1, caps);
    return intersect(ray_leaving(seen({1, 0, 0}, c)->point, {-2, 0, slope}), c);
  };
  for (const double slope : {0.5, 1.0, 3.0}) {
    ASSERT_TRUE(next(slope + 1e-9, slope, open)) << slope;
    EXPECT_LT(max_abs(next(slope + 1e-9, slope, open)->point.point() - Vec3{-1, 0, slope}), 1e-15);
    EXPECT_FALSE(next(slope - 1e-9, slope, open)) << slope;
    const auto cap = next(slope / 2, slope, closed);
    ASSERT_TRUE(cap) << slope;
    EXPECT_EQ(cap->point.normal, (Vec3{0, 0, -1}));
    EXPECT_LT(max_abs(cap->point.point() - Vec3{0, 0, slope / 2}), 1e-15);
  }
}

TEST(Cylinder, that_a_ray_leaves_from_the_inside_of_a_cap_is_met_at_the_other_one) {
  const PackedCylinder c = packed({0, 0, -2}, {0, 0, 3}, 1, closed);
  for (const double z : {1.0, -1.0}) {
    const auto cap = seen({0.25, 0, z}, packed({0, 0, -2}, {0, 0, 3}, 5, closed));
    ASSERT_TRUE(cap);
    EXPECT_EQ(cap->point.normal, (Vec3{0, 0, -z}));
    const auto first = seen({0.1, 0, z}, c);
    ASSERT_TRUE(first);
    const auto other = intersect(ray_leaving(first->point, {0, 0, -z}), c);
    ASSERT_TRUE(other);
    EXPECT_NEAR(other->t, 5, 1e-15);
    EXPECT_EQ(other->point.normal, (Vec3{0, 0, z}));
  }
}

TEST(Cylinder, far_away_keeps_its_silhouette) {
  // The ray passes the axis at `miss` radii. The textbook discriminant fails from D = 1e8 r on.
  for (const double away : {1e3, 1e6, 1e9, 1e12}) {
    for (const double miss : {0.0, 0.5, 0.99, 0.999, 1.001, 1.01, 1.5}) {
      const auto hit = seen({0, 0, 1}, packed({miss, -3, away}, {miss, 5, away}, 1, open));
      EXPECT_EQ(hit.has_value(), miss < 1) << away << ' ' << miss;
      if (!hit) continue;
      EXPECT_NEAR(hit->t, away - std::sqrt(1 - miss * miss), 1e-15 * away);
      // The place along the ray is rounded, but not the normal by as much of a radius.
      EXPECT_NEAR(hit->point.normal.x, -miss, 1e-15);
    }
  }
}

TEST(Cylinder, however_long_is_met_where_it_is_near) {
  for (const double reach : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    const Vec3 axis = unit(Vec3{1, 2, -0.5});
    const Vec3 across = unit(cross(axis, {0, 0, 1}));
    const Vec3 middle = 5 * across;
    // Its ends are rounded: the axis turns by 1e-16 and is moved by as much of what it is long.
    const auto hit = seen(across, packed(middle - reach * axis, middle + reach * axis, 2, closed));
    ASSERT_TRUE(hit) << reach;
    EXPECT_NEAR(hit->t, 3, 1e-15 * reach + 1e-14) << reach;
  }
}

TEST(Cylinder, lies_within_its_bounds) {
  Random random(66);
  for (int i = 0; i < 20'000; ++i) {
    const PackedCylinder c = random_cylinder(random, i % 2 == 0);
    const Box box = bounds(c);
    const auto hit = seen(point_within(c, random), c);
    if (!hit) continue;
    const Vec3 point = hit->point.point();
    const double rounding = 1e-14 * length(point);
    for (const int axis : {0, 1, 2}) {
      EXPECT_GE(component(point, axis), component(box.low, axis) - rounding);
      EXPECT_LE(component(point, axis), component(box.high, axis) + rounding);
    }
    EXPECT_GE(hit->t, nearest_distance(c) * (1 - 1e-12));
  }
}

TEST(Cylinder, tells_how_far_it_is) {
  EXPECT_EQ(nearest_distance(packed({0, -1, 5}, {0, 3, 5}, 2, closed)), 3);
  EXPECT_EQ(nearest_distance(packed({0, 0, 5}, {0, 0, 9}, 2, closed)), 5);
  EXPECT_EQ(nearest_distance(packed({0, 0, 3}, {0, 0, 9}, 4, open)), 5) << "its rim";
  EXPECT_LT(nearest_distance(packed({0, -1, 0.5}, {0, 3, 0.5}, 2, closed)), 0) << "inside";
  EXPECT_EQ(nearest_distance(packed({0, -1, 0.5}, {0, 3, 0.5}, 2, open)), 1.5);
}

}  // namespace
}  // namespace raytracer::test

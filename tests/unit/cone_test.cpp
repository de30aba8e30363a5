// Ray and cone: every case, closed and open, whole and cut off, from outside, inside and on it.
//
// A ray that leaves no surface begins at the eye, which is the origin here.

#include "engine/objects/cone/cone.h"

#include <gtest/gtest.h>

#include "engine/objects/cylinder/cylinder.h"
#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

constexpr bool with_caps = true;
constexpr bool without_caps = false;

template <class Document, class Primitive>
Primitive only_primitive(const Document& document) {
  const Frame frame;
  LargeArray<Primitive> primitives;
  double lost = 0;
  Packing<Primitive> packing{frame, nullptr, 0, primitives, lost};
  pack(document, packing);
  EXPECT_EQ(lost, 0);
  return primitives.at(0);
}

PackedCone packed_cone(const Vec3& from, const Vec3& to, double radius_from, double radius_to,
                       bool caps) {
  return only_primitive<Cone, PackedCone>(Cone{from, to, radius_from, radius_to, caps});
}

std::optional<SurfaceHit> seen_from_eye(const Vec3& direction, const PackedCone& cone) {
  return intersect(ray_from({}, direction), cone);
}

/// How far the point is outside of the side, negative inside.
double over_side(const PackedCone& c, const Vec3& point) {
  const double along = dot(point - c.foot, c.axis);
  return c.cosine * length(cross(point - c.foot, c.axis)) - c.girth(along);
}

/// How far it is beyond an end, negative between.
double over_ends(const PackedCone& c, const Vec3& point) {
  const double along = dot(point - c.foot, c.axis);
  return std::max(c.low - along, along - c.high);
}

/// What leaves the point to the side that it was seen from.
Ray leaving_anywhere(const SurfacePoint& point, Random& random) {
  const Vec3 direction = random.direction();
  return ray_leaving(point, dot(direction, point.normal) < 0 ? -direction : direction);
}

/// Of any size, direction and slope: whole, cut off, flat, slender, of equal radii.
PackedCone random_cone_at(const Vec3& middle, double size, Random& random, bool caps) {
  const Vec3 half = std::abs(random.magnitude(-3, 0.2)) * size * random.direction();
  double from = size * random.between(0.05, 1);
  double to = size * random.between(0.05, 1);
  const double which = random.between(0, 1);
  if (which < 0.3) from = 0;
  if (which > 0.7) to = 0;
  if (which > 0.45 && which < 0.55) to = from;
  return packed_cone(middle - half, middle + half, from, to, caps);
}

/// Seen from outside of it.
PackedCone random_cone(Random& random, bool caps) {
  const double size = std::abs(random.magnitude(-8, 0));
  return random_cone_at(random.between(3, 6) * size * random.direction(), size, random, caps);
}

/// A point of the closed cone's inside.
Vec3 point_inside(const PackedCone& c, Random& random, double share_of_radius = 0.9) {
  const double along = c.low + (c.high - c.low) * random.between(0.05, 0.95);
  const Vec3 across = unit(cross(c.axis, random.direction()));
  return c.foot + along * c.axis + share_of_radius * c.girth(along) / c.cosine * across;
}

TEST(Cone, is_met_at_its_near_side_from_outside) {
  for (const bool turned : {false, true})
    for (const bool caps : {with_caps, without_caps}) {
      const Vec3 base{0, -1, 5};
      const Vec3 tip{0, 3, 5};
      const auto hit = seen_from_eye({0, 0, 1}, turned ? packed_cone(tip, base, 0, 2, caps)
                                                       : packed_cone(base, tip, 2, 0, caps));
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->t, 3.5, 1e-15);
      EXPECT_LT(max_abs(hit->point.normal - unit(Vec3{0, 0.5, -1})), 1e-15);
      EXPECT_EQ(hit->point.side, SurfacePoint::Side::round_outside);
      EXPECT_LT(max_abs(hit->point.point() - Vec3{0, 0, 3.5}), 1e-15);
    }
}

TEST(Cone, is_met_at_the_cap_that_faces_the_eye) {
  for (const bool turned : {false, true}) {
    const Vec3 near{0.5, 0.25, 5};
    const Vec3 far{0.5, 0.25, 9};
    const auto hit = seen_from_eye({0, 0, 1}, turned ? packed_cone(far, near, 0, 2, with_caps)
                                                     : packed_cone(near, far, 2, 0, with_caps));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 5);
    EXPECT_EQ(hit->point.normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(hit->point.side, SurfacePoint::Side::flat);
  }
}

TEST(Cone, that_is_open_is_met_inside_through_its_end) {
  const PackedCone open = packed_cone({0, 0, 2}, {0, 0, 4}, 1, 0, without_caps);
  const auto hit = seen_from_eye({0.1, 0, 1}, open);  // x = z / 10 meets x = (4 - z) / 2
  ASSERT_TRUE(hit);
  EXPECT_LT(max_abs(hit->point.point() - Vec3{1.0 / 3, 0, 10.0 / 3}), 1e-15);
  EXPECT_LT(max_abs(hit->point.normal - unit(Vec3{-2, 0, -1})), 1e-15);
  EXPECT_EQ(hit->point.side, SurfacePoint::Side::round_inside);
  EXPECT_FALSE(seen_from_eye({0.51, 0, 1}, open));
}

TEST(Cone, is_met_up_to_its_tip) {
  Random random(80);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 tip = 5 * random.direction();
    const Vec3 axis = random.direction();
    const double half_angle = random.between(0.01, 1.5);
    const PackedCone c = packed_cone(tip + axis, tip, std::tan(half_angle), 0, i % 2 == 0);
    EXPECT_TRUE(seen_from_eye(tip + 1e-9 * axis, c)) << i;
    // Beyond the tip, unless something of the cone lies behind it.
    const Vec3 beyond = tip - 1e-9 * axis;
    if (std::abs(dot(unit(tip), axis)) < std::cos(half_angle + 0.01)) {
      EXPECT_FALSE(seen_from_eye(beyond, c)) << i;
    }
    const auto exact = seen_from_eye(tip, c);
    if (!exact) continue;
    EXPECT_NEAR(length(exact->point.normal), 1, 1e-15);
  }
}

TEST(Cone, of_equal_radii_is_a_cylinder) {
  Random random(81);
  int met = 0;
  for (int i = 0; i < 20'000; ++i) {
    const bool caps = i % 2 == 0;
    const Vec3 from = random.point(-3, 3);
    const Vec3 to = random.point(-3, 3);
    const double radius = random.between(0.1, 1);
    const PackedCone cone = packed_cone(from, to, radius, radius, caps);
    const auto cylinder = only_primitive<Cylinder, PackedCylinder>({from, to, radius, caps});
    Ray ray = ray_from({}, random.direction());
    for (int bounce = 0; bounce < 3; ++bounce) {
      const auto hit = intersect(ray, cone);
      const auto expected = intersect(ray, cylinder);
      ASSERT_EQ(hit.has_value(), expected.has_value()) << i << ' ' << bounce;
      if (!hit) break;
      ++met;
      ASSERT_NEAR(hit->t, expected->t, 1e-9) << i << ' ' << bounce;
      ASSERT_LT(max_abs(hit->point.normal - expected->point.normal), 1e-8);
      ray = leaving_anywhere(hit->point, random);
    }
  }
  EXPECT_GT(met, 5000);
}

TEST(Cone, is_met_along_its_axis) {
  for (const double aside : {0.0, 0.3}) {
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, unit(Vec3{1, 2, 3})}) {
      const Vec3 off = aside * unit(cross(axis, {0.3, 0.7, -0.2}));
      // Towards the tip, whose side rises by 5.
      const auto tip_first =
          seen_from_eye(axis, packed_cone(off + 2 * axis, off + 7 * axis, 0, 1, true));
      ASSERT_TRUE(tip_first);
      EXPECT_NEAR(tip_first->t, 2 + 5 * aside, 1e-14);
      const auto base_first =
          seen_from_eye(axis, packed_cone(off + 2 * axis, off + 7 * axis, 1, 0, true));
      ASSERT_TRUE(base_first);
      EXPECT_NEAR(base_first->t, 2, 1e-14);
      const auto inside =
          seen_from_eye(axis, packed_cone(off + 2 * axis, off + 7 * axis, 1, 0, false));
      ASSERT_TRUE(inside);
      EXPECT_NEAR(inside->t, 7 - 5 * aside, 1e-13);
      EXPECT_FALSE(seen_from_eye(-axis, packed_cone(off + 2 * axis, off + 7 * axis, 0, 1, true)));
    }
  }
}

TEST(Cone, that_is_closed_has_no_hole_at_its_rims) {
  Random random(82);
  for (int i = 0; i < 20'000; ++i) {
    const PackedCone c = random_cone(random, with_caps);
    const bool is_to = c.radius_from == 0 || (c.radius_to > 0 && i % 2 == 0);
    const Vec3 across = unit(cross(c.axis, random.direction()));
    const double inward = (is_to ? -1e-6 : 1e-6) * (c.high - c.low);
    const double along = (is_to ? c.high : c.low) + inward;
    const Vec3 target = c.foot + along * c.axis + (1 - 1e-6) * c.girth(along) / c.cosine * across;
    const auto hit = seen_from_eye(target, c);
    ASSERT_TRUE(hit) << i;
    const double rounding = 1e-14 * length(target);
    EXPECT_LE(over_side(c, hit->point.point()), rounding) << i;
    EXPECT_LE(over_ends(c, hit->point.point()), rounding) << i;
  }
}

TEST(Cone, that_is_flat_ends_at_its_rim) {
  // Seen along the axis, where side and plane nearly coincide, and from aside.
  for (const double rise : {1e-1, 1e-4, 1e-8, 1e-12})
    for (const double narrow : {0.0, 0.5})
      for (const double sign : {-1.0, 1.0}) {
        const PackedCone c = packed_cone({0, 0, 5}, {0, 0, 5 + sign * rise}, 1, narrow, with_caps);
        const double rim = 1 / 5.0;
        for (const double angle : {0.0, 0.7, 2.0}) {
          const Vec3 across{std::cos(angle), std::sin(angle), 0};
          EXPECT_TRUE(seen_from_eye((1 - 1e-12) * rim * across + Vec3{0, 0, 1}, c)) << rise;
          EXPECT_FALSE(seen_from_eye((1 + 1e-12) * rim * across + Vec3{0, 0, 1}, c)) << rise;
        }
      }
}

TEST(Cone, that_is_closed_is_met_from_inside_in_every_direction) {
  Random random(83);
  for (int i = 0; i < 20'000; ++i) {
    const PackedCone first = random_cone_at({}, 1, random, with_caps);
    const Vec3 eye = point_inside(first, random, random.between(0, 0.99));
    const PackedCone c = packed_cone(first.end(false) - eye, first.end(true) - eye,
                                     first.radius_from, first.radius_to, with_caps);
    const Vec3 across = unit(cross(c.axis, random.direction()));
    const bool is_to = i % 2 == 0;
    const Vec3 rim = c.end(is_to) + c.radius(is_to) * across;
    for (const Vec3& direction : {random.direction(), rim}) {
      const auto hit = seen_from_eye(direction, c);
      ASSERT_TRUE(hit) << i;
      EXPECT_LE(over_side(c, hit->point.point()), 1e-14) << i;
      EXPECT_LE(over_ends(c, hit->point.point()), 1e-14) << i;
    }
  }
}

TEST(Cone, that_a_ray_leaves_outwards_is_not_met_again) {
  Random random(84);
  for (int i = 0; i < 40'000; ++i) {
    const PackedCone c = random_cone(random, i % 2 == 0);
    const auto hit = seen_from_eye(point_inside(c, random, random.between(0, 0.999999)), c);
    if (!hit || hit->point.side == SurfacePoint::Side::round_inside) continue;
    EXPECT_FALSE(intersect(leaving_anywhere(hit->point, random), c)) << i;
  }
}

TEST(Cone, that_is_closed_keeps_what_leaves_its_inside) {
  Random random(85);
  for (int i = 0; i < 1000; ++i) {
    const PackedCone first = random_cone_at({}, 1, random, with_caps);
    const Vec3 eye = point_inside(first, random, random.between(0, 0.99));
    const PackedCone c = packed_cone(first.end(false) - eye, first.end(true) - eye,
                                     first.radius_from, first.radius_to, with_caps);
    auto hit = seen_from_eye(random.direction(), c);
    for (int bounce = 0; bounce < 40; ++bounce) {
      ASSERT_TRUE(hit) << i << ' ' << bounce;
      ASSERT_LE(over_side(c, hit->point.point()), 1e-12) << i << ' ' << bounce;
      ASSERT_LE(over_ends(c, hit->point.point()), 1e-12) << i << ' ' << bounce;
      ASSERT_NEAR(length(hit->point.normal), 1, 1e-14);
      hit = intersect(leaving_anywhere(hit->point, random), c);
    }
  }
}

TEST(Cone, that_is_open_is_met_on_its_other_side_from_inside) {
  // Across at half its height, where the radius is 1.
  const PackedCone c = packed_cone({0, -2, 0}, {0, 2, 0}, 2, 0, without_caps);
  const auto wall = seen_from_eye({1, 0, 0}, c);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->t, 1, 1e-15);
  const auto other = intersect(ray_leaving(wall->point, {-1, 0, 0}), c);
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->t, 2, 1e-15);
  // Downwards along the other wall's slope and below it the way leads out.
  EXPECT_FALSE(intersect(ray_leaving(wall->point, {-1, -2, 0}), c));
  EXPECT_FALSE(intersect(ray_leaving(wall->point, {-1, -1, 0}), c));
  EXPECT_TRUE(intersect(ray_leaving(wall->point, {-1, -0.6, 0}), c));
}

TEST(Cone, far_away_keeps_its_silhouette) {
  for (const double away : {1e3, 1e6, 1e9, 1e12}) {
    for (const double miss : {0.0, 0.5, 0.99, 0.999, 1.001, 1.01, 1.5}) {
      // At the height of the eye the radius is 1.
      const auto hit = seen_from_eye(
          {0, 0, 1}, packed_cone({miss, -4, away}, {miss, 4, away}, 2, 0, without_caps));
      EXPECT_EQ(hit.has_value(), miss < 1) << away << ' ' << miss;
    }
  }
}

TEST(Cone, however_long_is_met_where_it_is_near) {
  for (const double reach : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    const Vec3 axis = unit(Vec3{1, 2, -0.5});
    const Vec3 across = unit(cross(axis, {0, 0, 1}));
    const Vec3 middle = 5 * across;
    const auto hit = seen_from_eye(
        across, packed_cone(middle - reach * axis, middle + reach * axis, 2, 2.5, with_caps));
    ASSERT_TRUE(hit) << reach;
    EXPECT_NEAR(hit->t, 5 - 2.25, 0.01 / reach + 1e-15 * reach + 1e-14 + (reach == 1 ? 0.2 : 0))
        << reach;
  }
}

TEST(Cone, lies_within_its_bounds) {
  Random random(86);
  for (int i = 0; i < 20'000; ++i) {
    const PackedCone c = random_cone(random, i % 2 == 0);
    const Box box = bounds(c);
    const auto hit = seen_from_eye(point_inside(c, random), c);
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

TEST(Cone, tells_how_far_it_is) {
  EXPECT_NEAR(nearest_distance(packed_cone({0, -8, 5}, {0, 8, 5}, 3, 1, with_caps)),
              3 / std::hypot(1, 0.125), 1e-15);
  EXPECT_EQ(nearest_distance(packed_cone({0, 0, 5}, {0, 0, 9}, 2, 0, with_caps)), 5);
  EXPECT_EQ(nearest_distance(packed_cone({0, 0, 5}, {0, 0, 9}, 0, 2, with_caps)), 5);
  EXPECT_EQ(nearest_distance(packed_cone({0, 0, 3}, {0, 0, 9}, 4, 5, without_caps)), 5)
      << "its rim";
  EXPECT_LT(nearest_distance(packed_cone({0, -1, 0.5}, {0, 3, 0.5}, 2, 1, with_caps)), 0);
  EXPECT_GT(nearest_distance(packed_cone({0, -1, 0.5}, {0, 3, 0.5}, 2, 1, without_caps)), 0);
}

}  // namespace
}  // namespace raytracer::test

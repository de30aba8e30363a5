// Ray and sphere: every case, and accuracy where cancellation would eat it.

#include "engine/objects/sphere/sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/math/ray_sphere.h"
#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

std::optional<SphereHit> hit(const Ray& ray, const Vec3& center, double radius) {
  return intersect_sphere(ray, center, radius, false);
}

TEST(Sphere, is_hit_at_its_near_side_from_outside) {
  const auto found = hit(ray_from({0, 0, 0}, {0, 0, 1}), {0, 0, 5}, 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->t, 3);
  EXPECT_EQ(found->outward, (Vec3{0, 0, -1}));
  EXPECT_FALSE(found->is_inside);
}

TEST(Sphere, is_hit_at_its_far_side_from_inside) {
  const auto found = hit(ray_from({0, 0, 4}, {0, 0, 1}), {0, 0, 5}, 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->t, 3);
  EXPECT_EQ(found->outward, (Vec3{0, 0, 1}));
  EXPECT_TRUE(found->is_inside);
}

TEST(Sphere, is_hit_from_its_center) {
  const auto found = hit(ray_from({1, 2, 3}, {0, -1, 0}), {1, 2, 3}, 0.25);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->t, 0.25);
}

TEST(Sphere, behind_is_not_hit) {
  EXPECT_FALSE(hit(ray_from({0, 0, 0}, {0, 0, -1}), {0, 0, 5}, 2));
  EXPECT_FALSE(hit(ray_from({0, 0, 0}, {1, 0, -1e-9}), {0, 0, 5}, 4.999999));
}

TEST(Sphere, beside_is_not_hit) {
  EXPECT_FALSE(hit(ray_from({2.0000001, 0, 0}, {0, 0, 1}), {0, 0, 5}, 2));
  EXPECT_TRUE(hit(ray_from({1.9999999, 0, 0}, {0, 0, 1}), {0, 0, 5}, 2));
}

TEST(Sphere, is_touched_by_a_tangent) {
  const auto found = hit(ray_from({2, 0, 0}, {0, 0, 1}), {0, 0, 5}, 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->t, 5);
  EXPECT_EQ(found->outward, (Vec3{1, 0, 0}));
}

TEST(Sphere, from_a_point_on_its_surface_is_hit_only_on_its_other_side) {
  const Vec3 on_surface{0, 0, 3};
  const auto inwards = hit(ray_from(on_surface, {0, 0, 1}), {0, 0, 5}, 2);
  ASSERT_TRUE(inwards);
  EXPECT_EQ(inwards->t, 4);
  EXPECT_TRUE(inwards->is_inside);
  EXPECT_FALSE(hit(ray_from(on_surface, {0, 0, -1}), {0, 0, 5}, 2));
  EXPECT_FALSE(hit(ray_from(on_surface, {1, 0, 0}), {0, 0, 5}, 2));
}

TEST(Sphere, that_a_ray_leaves_is_not_hit_from_outside) {
  Random random(4);
  for (int i = 0; i < 20'000; ++i) {
    const PackedSphere sphere{random.point(-1, 1), std::abs(random.magnitude(-8, 0)), {}};
    const Ray ray = ray_towards(sphere.center + 3 * sphere.radius * random.direction(),
                                sphere.center + 0.7 * sphere.radius * random.direction());
    NearestHit query(ray);
    query.add(sphere);
    ASSERT_TRUE(query.found());
    Vec3 direction = random.direction();
    if (dot(direction, query.point().normal) < 0) direction = -direction;
    const Ray leaving = ray_leaving(query.point(), direction);
    AnyHit shadow(leaving, 1e30);
    shadow.add(sphere);
    EXPECT_FALSE(shadow.found());
  }
}

TEST(Sphere, that_a_ray_leaves_inwards_is_hit_at_the_chords_end) {
  const PackedSphere sphere{{5, 0, 0}, 2, {}};
  const Ray in = ray_from({5, 0, 0}, {0, 0, 1});
  NearestHit query(in);
  query.add(sphere);
  ASSERT_TRUE(query.found());
  EXPECT_EQ(query.point().normal, (Vec3{0, 0, -1}));
  const Ray back = ray_leaving(query.point(), {1, 0, -1});
  NearestHit next(back);
  next.add(sphere);
  ASSERT_TRUE(next.found());
  EXPECT_NEAR(next.t_max(), 2 * std::numbers::sqrt2, 1e-15);
  EXPECT_LT(max_abs(next.point().point() - Vec3{7, 0, 0}), 1e-15);
}

TEST(Sphere, far_away_keeps_its_silhouette) {
  // The ray passes the centre at `miss` radii. The textbook discriminant fails from D = 1e8 r on.
  for (const double distance : {1e3, 1e6, 1e9, 1e12}) {
    for (const double miss : {0.0, 0.5, 0.99, 0.999, 1.001, 1.01, 1.5}) {
      const Ray ray = ray_from({miss, 0, -distance}, {0, 0, 1});
      const auto found = hit(ray, {0, 0, 0}, 1);
      EXPECT_EQ(found.has_value(), miss < 1) << distance << ' ' << miss;
      if (!found) continue;
      EXPECT_NEAR(found->t, distance - std::sqrt(1 - miss * miss), 1e-15 * distance);
      EXPECT_NEAR(found->outward.x, miss, 1e-12);
    }
  }
}

TEST(Sphere, far_away_and_oblique_is_met_within_the_rounding_of_its_distance) {
  Random random(5);
  for (int i = 0; i < 20'000; ++i) {
    const double distance = std::pow(10, random.between(0.5, 6));
    const Vec3 center = distance * random.direction();
    const Ray ray = ray_towards({}, center + 0.9 * random.direction());
    // The same in long double, straight from the quadratic equation.
    const auto lift = [](const Vec3& a, const Vec3& b) {
      return static_cast<long double>(a.x) * b.x + static_cast<long double>(a.y) * b.y +
             static_cast<long double>(a.z) * b.z;
    };
    const long double d2 = lift(ray.direction, ray.direction);
    const long double b = lift(ray.direction, center) / d2;
    const long double c = (lift(center, center) - 1) / d2;
    const auto expected = static_cast<double>(b - std::sqrt(b * b - c));
    const auto found = hit(ray, center, 1);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->t, expected, 1e-15 * distance * distance);
    EXPECT_NEAR(length(found->outward), 1, 1e-9);
  }
}

TEST(Sphere, huge_one_just_below_the_eye_keeps_its_height) {
  // C = |f|^2 - r^2 cancels to nothing in plain arithmetic.
  for (const double radius : {1e3, 1e6, 1e9, 1e12}) {
    for (const double wanted : {1.0, 1e-2, 1e-3}) {
      const Vec3 center{0, -(radius + wanted), 0};
      const double height = -center.y - radius;  // exact: what the rounded centre leaves
      const auto straight = hit(ray_from({0, 0, 0}, {0, -1, 0}), center, radius);
      ASSERT_TRUE(straight) << radius << ' ' << wanted;
      EXPECT_FALSE(straight->is_inside);
      EXPECT_NEAR(straight->t / height, 1, 1e-9) << radius << ' ' << wanted;
      const Ray oblique_ray = ray_from({0, 0, 0}, {0.6, -0.8, 0});
      const auto oblique = hit(oblique_ray, center, radius);
      ASSERT_TRUE(oblique);
      // To first order in height / radius the sphere is a plane.
      EXPECT_NEAR(oblique->t * 0.8 / height, 1, 1e-9 + 2 * height / radius)
          << radius << ' ' << wanted;
    }
  }
}

TEST(Sphere, of_embrees_two_sphere_trap_is_the_nearer_one_at_the_right_distance) {
  const Ray ray =
      ray_from({14.8001127, -9.01768494, 3.47012758}, {-.989340246, -.0190101117, -.144376263});
  const PackedSphere first{{9.6687088, -16.3965702, 3.9399593}, 9, {0, 0}};
  const PackedSphere second{{10.0441875, -9.69345284, 3.94893074}, 9, {1, 0}};
  for (const bool swapped : {false, true}) {
    NearestHit query(ray);
    query.add(swapped ? second : first);
    query.add(swapped ? first : second);
    ASSERT_TRUE(query.found());
    EXPECT_EQ(query.point().id.object, 0U);
    EXPECT_NEAR(query.t_max(), 10.2983, 1e-4);
  }
}

/// All round the axis, and as far behind the sphere as matters: nothing is nearer, and something is
/// hardly farther.
TEST(Sphere, throws_the_edge_of_its_shadow_no_nearer_than_it_says) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 center = random.point(-4, 4);
    const PackedSphere sphere{center, random.between(0.1, 3), {}};
    PackedLight light;
    const bool is_far = i % 2 == 0;
    light.rays = is_far ? LightRays::parallel : LightRays::converging;
    light.place = is_far ? random.direction() : random.point(-9, 9);
    if (!is_far && length(sphere.center - light.place) <= sphere.radius) continue;
    double nearest = infinity;
    for (int turn = 0; turn < 400; ++turn) {
      const Vec3 back = is_far ? light.place : unit(light.place - sphere.center);
      const OrthonormalBasis across = orthonormal_basis(back);
      const double angle = 2 * std::numbers::pi * turn / 400;
      const Vec3 out = std::cos(angle) * across.u + std::sin(angle) * across.v;
      const double sine = is_far ? 0 : sphere.radius / length(sphere.center - light.place);
      const double cosine = std::sqrt(1 - sine * sine);
      const Vec3 touched = sphere.center + sphere.radius * (sine * back + cosine * out);
      const Vec3 onward = sine * out - cosine * back;
      for (double way = 0; way < 20; way += 0.02)
        nearest = std::min(nearest, length(touched + way * onward));
    }
    const double said = shadow_edge_distance(sphere, light);
    EXPECT_LE(said, nearest + 1e-9) << i;
    EXPECT_NEAR(said, nearest, 0.1) << i;
  }
}

TEST(Sphere, around_a_light_throws_its_shadow_anywhere) {
  PackedLight light;
  light.rays = LightRays::converging;
  light.place = {0, 0, 5.5};
  EXPECT_EQ(shadow_edge_distance({{0, 0, 5}, 1, {}}, light), 0);
}

}  // namespace
}  // namespace raytracer::test

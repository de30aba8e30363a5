// Trees of boxes answer single rays exactly as trying each primitive does.

#include "engine/reference/single_ray_finder.h"

#include <gtest/gtest.h>

#include "tests/support/rays.h"
#include "tests/support/reference_plan.h"

namespace raytracer::test {
namespace {

/// Compares one ray, bit for bit; returns what was hit.
std::optional<SurfacePoint> expect_same_hit(const Ray& ray, const SingleRayFinder& tree,
                                            const SingleRayFinder& force) {
  NearestHit by_tree(ray);
  NearestHit by_force(ray);
  tree.visit(by_tree);
  force.visit(by_force);
  EXPECT_EQ(by_tree.t_max(), by_force.t_max());
  const double far_enough = by_force.found() ? by_force.t_max() : 1;
  for (const double t_max : {far_enough / 2, far_enough, std::nextafter(far_enough, 1e300), 1e30}) {
    AnyHit any_by_tree(ray, t_max);
    AnyHit any_by_force(ray, t_max);
    tree.visit(any_by_tree);
    force.visit(any_by_force);
    EXPECT_EQ(any_by_tree.found(), any_by_force.found());
  }
  if (!by_tree.found() || !by_force.found()) return {};
  EXPECT_EQ(by_tree.point().id, by_force.point().id);
  EXPECT_EQ(by_tree.point().normal, by_force.point().normal);
  return by_force.point();
}

/// Rays from all around, and rays that leave what those meet.
void expect_same_hits(const PackedScene& scene, Random& random, int count = 300) {
  WorkerPool pool(2);
  const SingleRayFinder tree(scene, all_by(Finder::tree), pool);
  const SingleRayFinder force(scene);
  for (int i = 0; i < count; ++i) {
    Ray ray = ray_towards(random.point(-3, 3), random.point(-1, 1));
    if (i % 3 == 0) {
      Vec3 axis;
      (i % 2 == 0 ? axis.x : axis.z) = i % 4 < 2 ? 1 : -1;
      ray = ray_from(random.point(-1, 1) - 4 * axis, axis);
    }
    for (int bounce = 0; bounce < 3; ++bounce) {
      const auto surface = expect_same_hit(ray, tree, force);
      if (!surface) break;
      Vec3 direction = random.direction();
      if (dot(direction, surface->normal) < 0) direction = -direction;
      ray = ray_leaving(*surface, direction);
    }
  }
}

std::uint32_t next_object(const PackedScene& scene) {
  return static_cast<std::uint32_t>(of_kind<SphereKind>(scene.primitives).size() +
                                    of_kind<TriangleKind>(scene.primitives).size());
}

void add_sphere(PackedScene& scene, const Vec3& center, double radius) {
  of_kind<SphereKind>(scene.primitives).push_back({center, radius, {next_object(scene), 0}});
}

void add_triangle(PackedScene& scene, const Vec3& a, const Vec3& b, const Vec3& c) {
  of_kind<TriangleKind>(scene.primitives)
      .push_back(packed_triangle(a, b, c, {next_object(scene), 0}));
}

TEST(SingleRayFinder, of_nothing_hits_nothing) {
  Random random(20);
  expect_same_hits({}, random);
}

TEST(SingleRayFinder, of_few_is_hit_like_brute_force) {
  Random random(21);
  for (std::size_t count = 1; count <= 20; ++count) {
    PackedScene scene;
    for (std::size_t i = 0; i < count; ++i)
      add_sphere(scene, random.point(-1, 1), random.between(0.05, 0.4));
    expect_same_hits(scene, random);
  }
}

TEST(SingleRayFinder, of_spheres_and_triangles_is_hit_like_brute_force) {
  Random random(22);
  for (int round = 0; round < 6; ++round) {
    PackedScene scene;
    for (int i = 0; i < 200; ++i) {
      add_sphere(scene, random.point(-1, 1), std::abs(random.magnitude(-4, -0.7)));
      const Vec3 corner = random.point(-1, 1);
      const double size = std::abs(random.magnitude(-3, 0));
      add_triangle(scene, corner, corner + size * random.direction(),
                   corner + size * random.direction());
    }
    expect_same_hits(scene, random, 600);
  }
}

/// Of what is around an axis: document_of(random, from, to, caps). Rays without a surface begin at
/// the eye, which it is packed for.
template <class Kind, typename DocumentOf>
void expect_same_hits_around_axes(const DocumentOf& document_of) {
  Random random(28);
  for (int round = 0; round < 6; ++round) {
    PackedScene scene;
    double lost = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Vec3 from = Vec3{0, 0, 3} + random.point(-1, 1);
      // One after another: in which order operands draw is the compiler's choice.
      const Vec3 direction = random.direction();
      const Vec3 to = from + random.between(0.01, 1) * direction;
      Packing<typename Kind::Primitive> packing{scene.frame, nullptr, i,
                                                of_kind<Kind>(scene.primitives), lost};
      pack(document_of(random, from, to, i % 3 != 0), packing);
    }
    WorkerPool pool(2);
    const SingleRayFinder tree(scene, all_by(Finder::tree), pool);
    const SingleRayFinder force(scene);
    int met = 0;
    for (int i = 0; i < 600; ++i) {
      Ray ray = ray_towards({}, Vec3{0, 0, 3} + random.point(-1, 1));
      for (int bounce = 0; bounce < 3; ++bounce) {
        const auto surface = expect_same_hit(ray, tree, force);
        if (!surface) break;
        ++met;
        const Vec3 direction = random.direction();
        ray = ray_leaving(*surface, dot(direction, surface->normal) < 0 ? -direction : direction);
      }
    }
    EXPECT_GT(met, 500);
  }
}

TEST(SingleRayFinder, of_cylinders_is_hit_like_brute_force) {
  expect_same_hits_around_axes<CylinderKind>(
      [](Random& random, const Vec3& from, const Vec3& to, bool caps) {
        return Cylinder{from, to, std::abs(random.magnitude(-4, -0.7)), caps};
      });
}

TEST(SingleRayFinder, of_cones_is_hit_like_brute_force) {
  expect_same_hits_around_axes<ConeKind>(
      [](Random& random, const Vec3& from, const Vec3& to, bool caps) {
        return Cone{from, to, std::abs(random.magnitude(-3, -0.5)),
                    random.below(2) == 0 ? 0 : std::abs(random.magnitude(-3, -0.5)), caps};
      });
}

TEST(SingleRayFinder, of_flat_boxes_is_hit_like_brute_force) {
  Random random(23);
  PackedScene scene;
  for (int i = 0; i < 300; ++i) {
    // In planes across the axes, at places that rays' origins share.
    const double level = 0.25 * static_cast<double>(random.below(9)) - 1;
    const auto turned = [&](double a, double b) {
      return i % 3 == 0 ? Vec3{level, a, b} : i % 3 == 1 ? Vec3{a, level, b} : Vec3{a, b, level};
    };
    const double a = random.between(-1, 1);
    const double b = random.between(-1, 1);
    add_triangle(scene, turned(a, b), turned(a + 0.5, b), turned(a, b + 0.5));
  }
  expect_same_hits(scene, random, 2000);
  WorkerPool pool(2);
  const SingleRayFinder tree(scene, all_by(Finder::tree), pool);
  const SingleRayFinder force(scene);
  for (int i = 0; i < 1000; ++i) {
    const auto level = [&] { return 0.25 * static_cast<double>(random.below(9)) - 1; };
    Vec3 origin{level(), level(), level()};
    expect_same_hit(ray_from(origin, {0, 0, i % 2 == 0 ? 1.0 : -1.0}), tree, force);
    expect_same_hit(ray_from(origin, {random.between(-1, 1), 0, random.between(-1, 1)}), tree,
                    force);
  }
}

TEST(SingleRayFinder, of_thousands_in_one_place_is_hit_like_brute_force) {
  Random random(24);
  PackedScene same;
  for (int i = 0; i < 3000; ++i) add_sphere(same, {0.1, 0.2, 0.3}, 0.5);
  expect_same_hits(same, random, 30);
  PackedScene shells;
  for (int i = 0; i < 500; ++i) add_sphere(shells, {0.1, 0.2, 0.3}, 0.5 + 1e-6 * i);
  expect_same_hits(shells, random, 100);
}

TEST(SingleRayFinder, of_extreme_spread_is_hit_like_brute_force) {
  Random random(25);
  PackedScene scene;
  for (int i = 0; i < 400; ++i) {
    const double distance = std::abs(random.magnitude(-12, 0));
    add_sphere(scene, distance * random.direction(), distance * random.between(0.01, 0.5));
  }
  expect_same_hits(scene, random, 600);
}

TEST(SingleRayFinder, is_hit_like_brute_force_by_rays_that_leave_a_far_plane) {
  Random random(26);
  PackedScene scene;
  for (int i = 0; i < 200; ++i) add_sphere(scene, random.point(-1, 1), random.between(0.01, 0.1));
  of_kind<PlaneKind>(scene.primitives).push_back({{0, -1.2, 0}, {0, 1, 0}, {100'000, 0}});
  WorkerPool pool(2);
  const SingleRayFinder tree(scene, all_by(Finder::tree), pool);
  const SingleRayFinder force(scene);
  for (int i = 0; i < 3000; ++i) {
    const double far_away = std::abs(random.magnitude(0, 7));
    const Ray ray = ray_towards(
        {0, 3, 0}, {far_away * random.between(-1, 1), -1.2, far_away * random.between(-1, 1)});
    const auto surface = expect_same_hit(ray, tree, force);
    if (!surface) continue;
    const auto& spheres = of_kind<SphereKind>(scene.primitives);
    const PackedSphere& target = spheres[random.below(spheres.size())];
    expect_same_hit(
        ray_leaving(*surface, target.center + target.radius * Vec3{0, 1, 0} - surface->point()),
        tree, force);
    expect_same_hit(ray_leaving(*surface, target.center - surface->point()), tree, force);
  }
}

TEST(SingleRayFinder, of_a_long_chain_of_nested_halves_stays_within_its_stack) {
  // Each split by area peels off one sphere: the deepest tree that the heuristic makes.
  Random random(27);
  PackedScene scene;
  for (int i = 0; i < 900; ++i) add_sphere(scene, {std::ldexp(1.0, -i), 0, 0}, std::ldexp(0.3, -i));
  for (int i = 0; i < 900; ++i) add_sphere(scene, {0, std::ldexp(1.0, -i), 0}, std::ldexp(0.3, -i));
  expect_same_hits(scene, random, 100);
}

}  // namespace
}  // namespace raytracer::test

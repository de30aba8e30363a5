// Random scenes over sixteen orders of magnitude are the exact pictures.
//
// 300 of them; RAYTRACER_RANDOM_SCENES says another number. Scene i is that of seed i + 1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/plan/plan.h"
#include "tests/extremes/cases.h"
#include "tests/extremes/comparison.h"
#include "tests/support/rays.h"

namespace raytracer::extremes {
namespace {

using test::Random;

/// Spheres, squares and triangles, coordinates of 10^U(-8, 8), radii of 10^U(-4, 4), seen from a
/// point of the same kind, looking at one of them so that it is seen.
Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  const auto far_point = [&] {
    const double x = random.magnitude(-8, 8);
    const double y = random.magnitude(-8, 8);
    return Vec3{x, y, random.magnitude(-8, 8)};
  };
  const auto any_radius = [&] { return std::abs(random.magnitude(-4, 4)); };
  Scene scene;
  scene.materials = {{.ks = 0.2, .shininess = std::abs(random.magnitude(-2, 4))},
                     {.color = {0.9, 0.5, 0.2}, .reflectivity = random.between(0, 0.5)}};
  scene.background = {0.2, 0.3, 0.4};
  const auto add = [&](auto shape) {
    scene.objects.push_back({std::move(shape), random.below(4) == 0 ? 1U : 0U});
  };
  const Vec3 middle = far_point();
  const double radius = any_radius();
  add(Sphere{middle, radius});
  // Around it others of about its size, so that there is something to see, and some anywhere.
  for (int i = 0; i < 4; ++i)
    add(Sphere{middle + radius * random.between(1, 4) * random.direction(),
               radius * random.between(0.2, 1.5)});
  for (int i = 0; i < 3; ++i) add(Sphere{far_point(), any_radius()});
  const auto axes = static_cast<Axes>(random.below(3));
  add(SphereSquare{middle + 3 * radius * random.direction(), radius * random.between(0.05, 0.3),
                   1 + static_cast<std::int64_t>(random.below(8)), axes});
  const Vec3 corner = middle + 2 * radius * random.direction();
  add(Mesh{{corner, corner + 3 * radius * random.direction(),
            corner + 3 * radius * random.direction(), far_point()},
           {{0, 1, 2}, {1, 2, 3}}});
  if (random.below(3) == 0)
    add(Plane{middle - 3 * radius * random.direction(), random.direction()});
  scene.lights = {{DistantLight{random.direction()}},
                  {DistantLight{random.direction()}, {1, 1, 1}, 0.5}};
  const double away = radius * std::abs(random.magnitude(0.5, 4));
  scene.camera = {.origin = middle + away * random.direction(),
                  .look_at = middle,
                  .fov = std::min(2.5, 8 * radius / away),
                  .width = 24,
                  .height = 18};
  scene.render.max_depth = 3;
  return scene;
}

int scene_count() {
  const char* count = std::getenv("RAYTRACER_RANDOM_SCENES");
  return count == nullptr ? 300 : std::atoi(count);
}

TEST(RandomScenes, AreTheExactPictures) {
  const int count = scene_count();
  ASSERT_GT(count, 0) << "RAYTRACER_RANDOM_SCENES must be a number above 0";
  WorkerPool pool(2);
  int off = 0;
  int at_edge = 0;
  int nans = 0;
  int in_single = 0;
  int seen = 0;
  double levels = 0;
  for (int i = 0; i < count; ++i) {
    const Scene scene = random_scene(static_cast<std::uint64_t>(i) + 1);
    if (scene.camera.origin == scene.camera.look_at) continue;  // lost in the coordinates' rounding
    const Plan plan = make_plan(scene, this_machine(1));
    in_single += plan.precision.value == Precision::single_precision ? 1 : 0;
    const ExactImage exact = exact_image(scene, pool);
    for (const Vec3& color : exact) seen += color == scene.background ? 0 : 1;
    const Comparison result = compare(render_as(scene, Precision::automatic, pool), exact, scene);
    EXPECT_EQ(result.off, 0) << "seed " << i + 1 << ", " << result.displacement_px << " px; "
                             << plan.precision.reason;
    EXPECT_EQ(result.nans, 0) << "seed " << i + 1;
    EXPECT_LE(result.levels, plan.arithmetic_error.levels) << "seed " << i + 1;
    off += result.off;
    at_edge += result.at_edge;
    nans += result.nans;
    levels = std::max(levels, result.levels);
  }
  fmt::print(
      "seeds 1 to {}: {} pixels wrong, {} right within 1e-6 pixel, {} not numbers, the largest "
      "difference {:.2g} levels; {} scenes in single, {} pixels show an object\n",
      count, off, at_edge, nans, levels, in_single, seen);
  EXPECT_GT(seen, 50 * count);
}

}  // namespace
}  // namespace raytracer::extremes

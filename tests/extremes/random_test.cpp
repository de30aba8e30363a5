// Random scenes are the exact pictures: those over sixteen orders of magnitude, which the plan
// gives to double, and ordinary ones, which it gives to single.
//
// 300 of the former; RAYTRACER_RANDOM_SCENES says another number. Scene i is that of seed i + 1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/extremes/cases.h"
#include "tests/extremes/comparison.h"
#include "tests/support/edit.h"
#include "tests/support/rays.h"
#include "tests/support/scene_plan.h"

namespace raytracer::extremes {
namespace {

using test::Random;

/// How large coordinates, radii, and distances of the eye in radii are: 10^U(-x, x), the last
/// 10^U(0.5, x).
struct Magnitudes {
  double place;
  double radius;
  double away;
};

/// Spheres, squares and triangles, seen from where one of them fills a good part of the image.
Scene random_scene(std::uint64_t seed, const Magnitudes& size) {
  Random random(seed);
  const auto far_point = [&] {
    const double x = random.magnitude(-size.place, size.place);
    const double y = random.magnitude(-size.place, size.place);
    return Vec3{x, y, random.magnitude(-size.place, size.place)};
  };
  const auto any_radius = [&] { return std::abs(random.magnitude(-size.radius, size.radius)); };
  Scene scene;
  Material matt;
  matt.ks = 0.2;
  matt.shininess = std::abs(random.magnitude(-2, 4));
  Material mirror;
  mirror.color = {0.9, 0.5, 0.2};
  mirror.reflectivity = random.between(0, 0.5);
  scene.materials = {matt, mirror};
  scene.background = {0.2, 0.3, 0.4};
  const auto add = [&](auto shape) {
    test::append(scene.objects, {std::move(shape), random.below(4) == 0 ? 1U : 0U});
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
           {{0, 1, 2}, {1, 2, 3}},
           {},
           {}});
  if (random.below(3) == 0)
    add(Plane{middle - 3 * radius * random.direction(), random.direction()});
  scene.lights = {{DistantLight{random.direction()}},
                  {DistantLight{random.direction()}, {1, 1, 1}, 0.5}};
  const double away = radius * std::abs(random.magnitude(0.5, size.away));
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

struct Outcome {
  int off = 0;
  int at_edge = 0;
  int nans = 0;
  int in_single = 0;
  int seen = 0;  ///< pixels that show an object
  double levels = 0;
};

/// Renders the scenes of seeds 1 to `count`, expects each to be right, and prints the sums.
Outcome expect_exact_pictures(int count, const Magnitudes& size) {
  WorkerPool pool(2);
  Outcome sum;
  for (int seed = 1; seed <= count; ++seed) {
    const Scene scene = random_scene(static_cast<std::uint64_t>(seed), size);
    if (scene.camera.origin == scene.camera.look_at) continue;  // lost in the coordinates' rounding
    const Plan plan = make_plan(scene, this_machine(1));
    sum.in_single += plan.precision.value == Precision::single_precision ? 1 : 0;
    const ExactImage exact = exact_image(scene, pool);
    for (const Vec3& color : exact) sum.seen += color == scene.background ? 0 : 1;
    const Comparison result = compare(render_as(scene, Precision::automatic, pool), exact, scene);
    EXPECT_EQ(result.off, 0) << "seed " << seed << ", " << result.displacement_px << " px; "
                             << plan.precision.reason();
    EXPECT_LE(result.displacement_px, plan.arithmetic_error.displacement_px) << "seed " << seed;
    EXPECT_EQ(result.nans, 0) << "seed " << seed;
    EXPECT_LE(result.levels, plan.arithmetic_error.levels) << "seed " << seed;
    sum.off += result.off;
    sum.at_edge += result.at_edge;
    sum.nans += result.nans;
    sum.levels = std::max(sum.levels, result.levels);
  }
  fmt::print(
      "seeds 1 to {}: {} pixels wrong, {} right within 1e-6 pixel, {} not numbers, the largest "
      "difference {:.2g} levels; {} scenes in single; {} pixels show an object\n",
      count, sum.off, sum.at_edge, sum.nans, sum.levels, sum.in_single, sum.seen);
  return sum;
}

TEST(RandomScenes, over_sixteen_orders_of_magnitude_are_the_exact_pictures) {
  const int count = scene_count();
  ASSERT_GT(count, 0) << "RAYTRACER_RANDOM_SCENES must be a number above 0";
  const Outcome sum = expect_exact_pictures(count, {8, 4, 4});
  EXPECT_GT(sum.seen, 50 * count);
}

TEST(RandomScenes, of_ordinary_sizes_are_the_exact_pictures_in_single) {
  constexpr int count = 100;
  const Outcome sum = expect_exact_pictures(count, {1, 0.5, 1});
  EXPECT_GT(sum.in_single, count / 2);
}

}  // namespace
}  // namespace raytracer::extremes

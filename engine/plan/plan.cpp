#include "engine/plan/plan.h"

#include "engine/plan/tiles.h"

namespace raytracer {
namespace {

// Random spheres under two lights, brute force's time over the tree's: 0.90 to 0.94 with 2 to 6
// spheres, 1.04 with 8, 1.15 with 12, 1.9 with 32.
constexpr std::size_t few_for_one_ray = 7;

Choice<Kernel> choose_kernel(const Features& features, const Census& census) {
  const std::size_t bounded = features.spheres + features.triangles;
  if (census.nearest > 0)
    return {Kernel::simd,
            because("the eye is outside of everything, so neighbouring rays go together")};
  return {
      bounded <= few_for_one_ray ? Kernel::brute_force : Kernel::bvh,
      because("the eye is on or inside a surface, which only the plain kernel models: one ray at "
              "a time, in double, several times slower")};
}

Choice<Precision> precision_for(const Scene& scene, const Plan& plan) {
  if (plan.kernel.value == Kernel::simd)
    return choose_precision(scene.render.precision, plan.features, plan.census);
  return {Precision::double_precision,
          because("the plain kernel that this scene needs has no other")};
}

}  // namespace

Plan make_plan(const Scene& scene, const Machine& machine, WorkerPool* pool) {
  Plan plan;
  plan.features = find_features(scene);
  plan.frame = make_frame(scene);
  plan.census = take_census(scene, plan.frame, plan.features, pool);
  plan.kernel = choose_kernel(plan.features, plan.census);
  plan.precision = precision_for(scene, plan);
  plan.arithmetic_error =
      foresee_arithmetic_error(plan.precision.value, plan.features, plan.census);
  plan.structures = choose_structures(plan.features, plan.census);
  plan.sampling = choose_sampling(scene.render, plan.census);
  plan.instruction_set = machine.instruction_set;
  plan.tile_side_px =
      choose_tile_side(scene, first_samples(scene.render, plan.census), machine.thread_count);
  return plan;
}

}  // namespace raytracer

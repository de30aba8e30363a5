#include "engine/plan/plan.h"

#include "engine/plan/tiles.h"

namespace raytracer {
namespace {

Choice<Precision> precision_for(const Scene& scene, const Plan& plan) {
  if (plan.kernel.value == Kernel::packets)
    return choose_precision(scene.render.precision, plan.features, plan.statistics);
  return {Precision::double_precision,
          because("the reference, which this scene needs, has no other")};
}

}  // namespace

Plan make_plan(const Scene& scene, const PackedScene& packed, const Machine& machine,
               WorkerPool* pool) {
  Plan plan;
  plan.features = find_features(scene);
  plan.frame = packed.frame;
  plan.statistics = gather_statistics(scene, packed, plan.features, pool);
  plan.kernel = choose_kernel(plan.statistics);
  plan.precision = precision_for(scene, plan);
  plan.arithmetic_error =
      predict_arithmetic_error(plan.precision.value, plan.features, plan.statistics);
  plan.light_sampling =
      choose_light_sampling(scene, plan.features, first_samples(scene.render, plan.statistics));
  plan.finders = choose_finders(
      plan.features, plan.statistics, plan.kernel.value,
      choose_soft_light_search(scene.render, plan.features, plan.light_sampling.value));
  plan.sampling = choose_sampling(scene.render, plan.statistics);
  plan.instruction_set = machine.instruction_set;
  plan.tile_side_px =
      choose_tile_side(scene, first_samples(scene.render, plan.statistics), machine.thread_count);
  return plan;
}

int light_samples_of(const Plan& plan, double samples) {
  if (plan.features.soft_lights == 0) return 0;
  return light_samples_per_pixel(plan.light_sampling.value, samples);
}

}  // namespace raytracer

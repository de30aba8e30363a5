#include "server/cluster/cut.h"

#include <algorithm>
#include <cmath>

namespace raytracer {
namespace {

constexpr double most_bytes = 3'500'000;     // of a result, below the store's limit for a message
constexpr double slow_ray_ms = 2e-4;         // most take a tenth of that
constexpr double error_bytes_per_pixel = 1;  // of RegionRendering::subtile_error2, rounded up

}  // namespace

bool is_short(const PreparedScene& scene, double ms, std::size_t thread_count) {
  const Scene& view = scene.scene();
  if (scene.plan().kernel.value != Kernel::packets) return false;
  if (sampling_of(view.render) == Sampling::contract)
    return view.render.budget_ms.value_or(ms) < ms;
  const double rays = count_rays(view, view.render.samples.value_or(1)) *
                      (1 + static_cast<double>(light_rays_per_sample(view)));
  return rays * slow_ray_ms / static_cast<double>(thread_count) < ms;
}

TaskCut cut_into_tasks(const PreparedScene& scene, const Prediction& prediction, bool is_8_bit) {
  TaskCut cut{.predicted_ms = prediction.trace_ms,
              .plan_ms = scene.plan_ms(),
              .build_ms = scene.build_ms()};
  const Camera& camera = scene.scene().camera;
  if (scene.plan().sampling.value == Sampling::contract) return cut;
  const double pixels = camera.pixel_count();
  const double thread_ms = prediction.trace_ms * static_cast<double>(prediction.thread_count);
  const double value_bytes = is_8_bit ? 1 : sizeof(float);
  const double pixel_bytes = channel_count(scene.scene()) * value_bytes + error_bytes_per_pixel;
  const double tasks =
      std::max({thread_ms / (1000 * task_s), pixels * pixel_bytes / most_bytes, 1.0});
  const auto blocks = static_cast<int>(std::sqrt(pixels / tasks) / region_unit_px);
  const int whole = std::max(camera.width, camera.height) / region_unit_px + 1;
  cut.side_px = region_unit_px * std::clamp(blocks, 1, whole);
  cut.task_count = static_cast<int>(regions_of(camera.width, camera.height, cut.side_px).size());
  return cut;
}

}  // namespace raytracer

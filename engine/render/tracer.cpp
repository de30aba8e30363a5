#include "engine/render/tracer.h"

#include <algorithm>
#include <cmath>

#include "engine/image/transfer.h"
#include "engine/kernel/radiance.h"

namespace raytracer {
namespace {

Rgb clamped(const Rgb& c) {
  return {std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)};
}

float encoded(double linear, Transfer transfer) {
  // Most images are linear: not a call for each channel of each pixel.
  return static_cast<float>(transfer == Transfer::linear ? linear
                                                         : encode_channel(linear, transfer));
}

void store(float channel, float& to) { to = channel; }
void store(float channel, unsigned char& to) { to = to_byte(channel); }

void store(const Rgb& mean, Transfer transfer, auto* pixel) {
  store(encoded(mean.x, transfer), pixel[0]);
  store(encoded(mean.y, transfer), pixel[1]);
  store(encoded(mean.z, transfer), pixel[2]);
}

/// Whether a sample of this colour is clamped, and whether it is no number.
BeyondRange beyond_range(const Rgb& c) {
  const bool is_number = !std::isnan(c.x) && !std::isnan(c.y) && !std::isnan(c.z);
  return {is_number && max_abs(c) > 1 ? 1U : 0U, is_number ? 0U : 1U};
}

BeyondRange trace(const ReferenceTracer& tracer, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas) {
  const PackedScene& scene = *tracer.scene;
  BeyondRange beyond;
  const auto trace_with = [&](const auto& structure, auto* image) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        if ((tile.parts >> tile.part_of(x, y) & 1) == 0) continue;
        const SamplePoint moved = stagger_of(x, y);
        Rgb sum;
        BeyondRange seen;
        for (const SamplePoint& sample : pattern.points) {
          const Rgb color = radiance(
              scene, structure,
              scene.view.direction(x + sample.x + pattern.stagger * moved.x,
                                   image->height - 1 - y + sample.y + pattern.stagger * moved.y));
          seen += beyond_range(color);
          sum += clamped(color);
        }
        beyond.not_numbers += seen.not_numbers > 0 ? 1 : 0;
        beyond.clamped += seen.clamped > 0 && seen.not_numbers == 0 ? 1 : 0;
        store(sum / static_cast<double>(pattern.points.size()), transfer, image->pixel(x, y));
      }
    }
  };
  std::visit(trace_with, tracer.structure, canvas);
  return beyond;
}

template <typename T>
BeyondRange trace(const SimdTracer<T>& tracer, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas) {
  return render_tile(tracer.scene, pattern, transfer, tile, tracer.target, canvas).beyond;
}

}  // namespace

Tracer make_tracer(const Plan& plan, const Scene& scene, WorkerPool& pool) {
  PackedScene packed = pack_scene(scene, plan.frame, pool);
  if (plan.kernel.value == Kernel::simd) {
    const std::int64_t target = plan.instruction_set.target;
    if (plan.precision.value == Precision::single_precision)
      return SimdTracer<float>{make_simd_scene<float>(packed, plan.features, plan.structures, pool),
                               target};
    return SimdTracer<double>{make_simd_scene<double>(packed, plan.features, plan.structures, pool),
                              target};
  }
  auto kept = std::make_unique<const PackedScene>(std::move(packed));
  const PackedScene& reference = *kept;
  if (plan.kernel.value == Kernel::bvh)
    return ReferenceTracer{std::move(kept), Bvh::build(reference, pool)};
  return ReferenceTracer{std::move(kept), BruteForce(reference)};
}

BeyondRange render_tile(const Tracer& tracer, const SamplePattern& pattern, Transfer transfer,
                        const Tile& tile, const Canvas& canvas) {
  return std::visit(
      [&](const auto& chosen) { return trace(chosen, pattern, transfer, tile, canvas); }, tracer);
}

}  // namespace raytracer

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

Rgb encoded(const Rgb& linear, Transfer transfer) {
  // Most images are linear: not a call for each channel of each pixel.
  if (transfer == Transfer::linear) return linear;
  return {encode_channel(linear.x, transfer), encode_channel(linear.y, transfer),
          encode_channel(linear.z, transfer)};
}

void store(double channel, float& to) { to = static_cast<float>(channel); }
void store(double channel, unsigned char& to) { to = to_byte(static_cast<float>(channel)); }

void store(const Rgb& mean, Transfer transfer, auto* pixel) {
  const Rgb color = encoded(mean, transfer);
  store(color.x, pixel[0]);
  store(color.y, pixel[1]);
  store(color.z, pixel[2]);
}

/// Whether a sample of this colour is clamped, and whether it is no number.
BeyondRange beyond_range(const Rgb& c) {
  const bool is_number = !std::isnan(c.x) && !std::isnan(c.y) && !std::isnan(c.z);
  return {is_number && max_abs(c) > 1 ? 1U : 0U, is_number ? 0U : 1U};
}

BeyondRange trace(const ReferenceTracer& tracer, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas, PartErrors* errors) {
  const PackedScene& scene = *tracer.scene;
  BeyondRange beyond;
  const auto trace_with = [&](const auto& structure, auto* image) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        if ((tile.parts >> tile.part_of(x, y) & 1) == 0) continue;
        const SamplePoint moved = stagger_of(x, y);
        BeyondRange seen;
        const auto sum_of = [&](std::size_t begin, std::size_t end) {
          Rgb sum;
          for (std::size_t i = begin; i < end; ++i) {
            const SamplePoint& sample = pattern.points[i];
            const double across = away_from_middle(sample.x, pattern.stagger) * moved.x;
            const double up = away_from_middle(sample.y, pattern.stagger) * moved.y;
            const Rgb color = radiance(
                scene, structure,
                scene.view.direction(x + sample.x + across, image->height - 1 - y + sample.y + up));
            seen += beyond_range(color);
            sum += clamped(color);
          }
          return sum;
        };
        const std::size_t count = pattern.points.size();
        const Rgb half = sum_of(0, pattern.first_half);
        const Rgb rest = sum_of(pattern.first_half, count);
        beyond.not_numbers += seen.not_numbers > 0 ? 1 : 0;
        beyond.clamped += seen.clamped > 0 && seen.not_numbers == 0 ? 1 : 0;
        store((half + rest) / static_cast<double>(count), transfer, image->pixel(x, y));
        if (errors != nullptr && pattern.has_halves()) {
          const Rgb difference = encoded(half / static_cast<double>(pattern.first_half), transfer) -
                                 encoded(rest / static_cast<double>(pattern.first_half), transfer);
          const int to_x = (x - tile.x_begin) % block_side;
          const int to_y = (y - tile.y_begin) % block_side;
          errors->of_block(x - to_x, y - to_y)[tile.part_of(x, y)] +=
              PartErrors::share * dot(difference, difference);
        }
      }
    }
  };
  std::visit(trace_with, tracer.structure, canvas);
  return beyond;
}

template <typename T>
BeyondRange trace(const SimdTracer<T>& tracer, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas, PartErrors* errors) {
  return render_tile(tracer.scene, pattern, transfer, tile, tracer.target, canvas, errors).beyond;
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
                        const Tile& tile, const Canvas& canvas, PartErrors* errors) {
  return std::visit(
      [&](const auto& chosen) { return trace(chosen, pattern, transfer, tile, canvas, errors); },
      tracer);
}

}  // namespace raytracer

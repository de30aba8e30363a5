#include "engine/render/tracer.h"

#include <algorithm>
#include <cmath>

#include "engine/image/transfer.h"
#include "engine/kernel/radiance.h"

namespace raytracer {
namespace {

/// What is no number becomes 1, as a kernel of vectors has it.
Rgb clamped(const Rgb& c) {
  const auto channel = [](double value) { return std::fmax(0.0, std::fmin(value, 1.0)); };
  return {channel(c.x), channel(c.y), channel(c.z)};
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

/// Sums over a pixel's samples.
struct PixelSums {
  Rgb half{};  ///< of the pattern's first
  Rgb rest{};
  Rgb origin{};        ///< a sample
  double squares = 0;  ///< of the others' differences from it
  BeyondRange seen{};

  /// Of all of them.
  Rgb mean(const SamplePattern& pattern) const {
    return (half + rest) / static_cast<double>(pattern.points.size());
  }

  /// If the pattern has halves.
  PixelSpread spread(const SamplePattern& pattern, Transfer transfer) const {
    const auto size = static_cast<double>(pattern.first_half);
    const Rgb difference = encoded(half / size, transfer) - encoded(rest / size, transfer);
    const Rgb middle = mean(pattern);
    double variance = squares / (2 * size) - dot(middle - origin, middle - origin);
    if (transfer != Transfer::linear) {
      const double deviation = std::sqrt(std::max(variance, 0.0) / 3);
      const Rgb deviations{deviation, deviation, deviation};
      const Rgb range = encoded(clamped(middle + deviations), transfer) -
                        encoded(clamped(middle - deviations), transfer);
      variance = dot(range, range) / 4;
    }
    const double error2 = PartErrors::share * dot(difference, difference);
    variance = std::max(variance, error2);
    return {error2 > 0 ? static_cast<float>(error2) : 0,
            variance > 0 ? static_cast<float>(variance) : 0};
  }
};

template <typename Structure>
PixelSums sample_pixel(const PackedScene& scene, const Structure& structure,
                       const SamplePattern& pattern, int x, int y) {
  const SamplePoint moved = stagger_of(x, y);
  PixelSums sums;
  for (std::size_t i = 0; i < pattern.points.size(); ++i) {
    const SamplePoint& sample = pattern.points[i];
    const double across = away_from_middle(sample.x, pattern.stagger) * moved.x;
    const double up = away_from_middle(sample.y, pattern.stagger) * moved.y;
    const Rgb color = radiance(
        scene, structure,
        scene.view.direction(x + sample.x + across, scene.view.height - 1 - y + sample.y + up));
    const Rgb seen = clamped(color);
    sums.seen += beyond_range(color);
    (i < pattern.first_half ? sums.half : sums.rest) += seen;
    if (i == 0) sums.origin = seen;
    sums.squares += dot(seen - sums.origin, seen - sums.origin);
  }
  return sums;
}

BeyondRange trace(const ReferenceTracer& tracer, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas, const TileErrors& errors) {
  BeyondRange beyond;
  const auto trace_with = [&](const auto& structure, auto* image) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        if ((tile.parts >> tile.part_of(x, y) & 1) == 0) continue;
        const PixelSums sums = sample_pixel(*tracer.scene, structure, pattern, x, y);
        const BeyondRange& seen = sums.seen;
        beyond.not_numbers += seen.not_numbers > 0 ? 1 : 0;
        beyond.clamped += seen.clamped > 0 && seen.not_numbers == 0 ? 1 : 0;
        store(sums.mean(pattern), transfer, image->pixel(x, y));
        if (!errors.are_wanted() || !pattern.has_halves()) continue;
        const PixelSpread spread = sums.spread(pattern, transfer);
        if (errors.parts != nullptr)
          errors.parts->of_block(x - (x - tile.x_begin) % block_side,
                                 y - (y - tile.y_begin) % block_side)[tile.part_of(x, y)] +=
              spread.error2;
        if (errors.pixels != nullptr) errors.pixels->set(errors.pixels->index(x, y), spread);
      }
    }
  };
  std::visit(trace_with, tracer.structure, canvas);
  return beyond;
}

void sample(const ReferenceTracer& tracer, const SamplePattern& pattern, Transfer transfer,
            const BlockPixels& pixels, std::span<SampledPixel> results) {
  const auto sample_with = [&](const auto& structure) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      const PixelSums sums = sample_pixel(*tracer.scene, structure, pattern,
                                          pixels.x_begin + pixels.places[i] % block_side,
                                          pixels.y_begin + pixels.places[i] / block_side);
      store(sums.mean(pattern), transfer, results[i].color.data());
      results[i].spread = sums.spread(pattern, transfer);
      results[i].is_number = sums.seen.not_numbers == 0;
    }
  };
  std::visit(sample_with, tracer.structure);
}

template <typename T>
BeyondRange trace(const SimdTracer<T>& tracer, const SamplePattern& pattern, Transfer transfer,
                  const Tile& tile, const Canvas& canvas, const TileErrors& errors) {
  return render_tile(tracer.scene, pattern, transfer, tile, tracer.target, canvas, errors).beyond;
}

template <typename T>
void sample(const SimdTracer<T>& tracer, const SamplePattern& pattern, Transfer transfer,
            const BlockPixels& pixels, std::span<SampledPixel> results) {
  sample_pixels(tracer.scene, pattern, transfer, pixels, tracer.target, results);
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
                        const Tile& tile, const Canvas& canvas, const TileErrors& errors) {
  return std::visit(
      [&](const auto& chosen) { return trace(chosen, pattern, transfer, tile, canvas, errors); },
      tracer);
}

void sample_pixels(const Tracer& tracer, const SamplePattern& pattern, Transfer transfer,
                   const BlockPixels& pixels, std::span<SampledPixel> results) {
  std::visit([&](const auto& chosen) { sample(chosen, pattern, transfer, pixels, results); },
             tracer);
}

}  // namespace raytracer

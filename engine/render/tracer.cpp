#include "engine/render/tracer.h"

#include <algorithm>
#include <cmath>

#include "engine/errors/error_model.h"
#include "engine/math/transfer.h"
#include "engine/reference/radiance.h"
#include "engine/render/swept_light.h"

namespace raytracer {
namespace {

/// What is no number becomes 1, as a kernel of vectors has it.
Rgb clamped(const Rgb& c) {
  const auto channel = [](double value) { return std::fmax(0.0, std::fmin(value, 1.0)); };
  return {channel(c.x), channel(c.y), channel(c.z)};
}

/// The mean of samples; those that met nothing are black where the image has a cover, and count as
/// others where it has none.
struct Mean {
  Rgb color;
  double cover = 1;
};

Rgb encoded(const Mean& linear, Transfer transfer) {
  // Most images are linear: not a call for each channel of each pixel.
  if (transfer == Transfer::linear || linear.cover == 0) return linear.color;
  const Rgb color = linear.color / linear.cover;
  return linear.cover * Rgb{encode_channel(color.x, transfer), encode_channel(color.y, transfer),
                            encode_channel(color.z, transfer)};
}

void store(double channel, float& to) { to = static_cast<float>(channel); }
void store(double channel, unsigned char& to) { to = to_byte(static_cast<float>(channel)); }

void store(const Mean& mean, Transfer transfer, int channels, auto* pixel) {
  const Rgb color = encoded(mean, transfer);
  store(color.x, pixel[0]);
  store(color.y, pixel[1]);
  store(color.z, pixel[2]);
  if (channels == 4) store(mean.cover, pixel[3]);
}

/// Whether a sample of this colour is clamped, and whether it is no number.
BeyondRange beyond_range(const Rgb& c) {
  const bool is_number = !std::isnan(c.x) && !std::isnan(c.y) && !std::isnan(c.z);
  return {is_number && max_abs(c) > 1 ? 1U : 0U, is_number ? 0U : 1U};
}

/// What the means of a pixel's half buffers and the variance of its samples tell.
PixelSpread spread_of(const Mean& half_a, const Mean& half_b, double variance, Transfer transfer) {
  const Rgb difference = encoded(half_a, transfer) - encoded(half_b, transfer);
  const double uncovered = half_a.cover - half_b.cover;
  const double error2 = SampleErrorModel::half_difference_share *
                        (dot(difference, difference) + uncovered * uncovered);
  variance = std::max(variance, error2);
  return {error2 > 0 ? static_cast<float>(error2) : 0,
          variance > 0 ? static_cast<float>(variance) : 0};
}

/// What a pixel's samples came to; `spread` only if the pattern has half buffers.
struct PixelValue {
  Mean mean;
  PixelSpread spread{};
  BeyondRange seen{};
};

/// The halves are compared after the transfer.
PixelValue sample_pixel(const ReferenceTracer& tracer, const SamplePattern& pattern,
                        Transfer transfer, int x, int y, int channels) {
  const View& view = tracer.scene->view;
  const int sets = tracer.scene->light_sets;
  PixelValue pixel;
  Mean half_a{{}, 0};
  Mean half_b{{}, 0};
  Rgb origin{};        // a sample
  double squares = 0;  // of the others' differences from it
  for (std::size_t i = 0; i < pattern.points.size(); ++i) {
    const SamplePoint sample = sample_in(x, y, pattern.points[i], pattern.jitter);
    const int light_set = light_set_of_sample(i, pattern.half_a_count, sets);
    const Sight sight = see(*tracer.scene, tracer.finder,
                            view.direction(x + sample.x, view.height - 1 - y + sample.y),
                            static_cast<std::size_t>(light_set_of(x, y, light_set, sets)),
                            static_cast<std::size_t>(light_set));
    const Rgb seen = clamped(sight.radiance);
    pixel.seen += beyond_range(sight.radiance);
    Mean& half = i < pattern.half_a_count ? half_a : half_b;
    half.color += seen;
    half.cover += channels == 3 || sight.meets_object ? 1 : 0;
    if (i == 0) origin = seen;
    squares += dot(seen - origin, seen - origin);
  }
  const auto count = static_cast<double>(pattern.points.size());
  const auto mean_of = [](const Mean& sum, double of) {
    return Mean{sum.color / of, sum.cover / of};
  };
  pixel.mean = mean_of({half_a.color + half_b.color, half_a.cover + half_b.cover}, count);
  if (!pattern.has_half_buffers()) return pixel;
  const Rgb shift = pixel.mean.color - origin;
  const double cover = pixel.mean.cover;
  const double variance = squares / count - dot(shift, shift) + cover * (1 - cover);
  pixel.spread =
      spread_of(mean_of(half_a, count / 2), mean_of(half_b, count / 2), variance, transfer);
  return pixel;
}

BeyondRange trace(const ReferenceTracer& tracer, const SamplePattern& pattern, const Tile& tile,
                  const TileOutput& output) {
  BeyondRange beyond;
  const TileErrors& errors = output.errors;
  const Transfer told_after = errors.pixels != nullptr ? Transfer::linear : output.transfer;
  const auto trace_into = [&](auto* image) {
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) {
        const int subtile = tile.subtile_of(x, y);
        if ((tile.subtiles >> subtile & 1) == 0) continue;
        const PixelValue pixel = sample_pixel(tracer, pattern, told_after, x, y, image->channels);
        beyond.not_numbers += pixel.seen.not_numbers > 0 ? 1 : 0;
        beyond.clamped += pixel.seen.clamped > 0 && pixel.seen.not_numbers == 0 ? 1 : 0;
        store(pixel.mean, output.transfer, image->channels, image->pixel(x, y));
        if (errors.subtiles != nullptr)
          errors.subtiles->of_block(x - (x - tile.x_begin) % block_side,
                                    y - (y - tile.y_begin) % block_side)[subtile] +=
              pixel.spread.error2;
        if (errors.pixels != nullptr) errors.pixels->set(errors.pixels->index(x, y), pixel.spread);
      }
    }
  };
  std::visit(trace_into, output.canvas);
  return beyond;
}

void sample(const ReferenceTracer& tracer, const SamplePattern& pattern, Transfer transfer,
            std::span<const BlockPixels> blocks, std::span<SampledPixel> results) {
  auto result = results.begin();
  for (const BlockPixels& pixels : blocks)
    for (const std::uint8_t place : pixels.places) {
      const PixelValue pixel =
          sample_pixel(tracer, pattern, Transfer::linear, pixels.x_begin + place % block_side,
                       pixels.y_begin + place / block_side, pixels.channels);
      store(pixel.mean, transfer, pixels.channels, result->values.data());
      result->spread = pixel.spread;
      result->is_number = pixel.seen.not_numbers == 0;
      ++result;
    }
}

template <typename T>
BeyondRange trace(const PacketTracer<T>& tracer, const SamplePattern& pattern, const Tile& tile,
                  const TileOutput& output) {
  if (tracer.scene.sweeps_soft_light) {
    SweptLight<T> light(tracer.scene, tracer.target, 1);
    light.record(0, pattern, tile);
    light.sweep();
    return light.render_tile(0, pattern, tile, output);
  }
  return render_tile(tracer.scene, pattern, tile, tracer.target, output).beyond;
}

template <typename T>
void sample(const PacketTracer<T>& tracer, const SamplePattern& pattern, Transfer transfer,
            std::span<const BlockPixels> blocks, std::span<SampledPixel> results) {
  sample_pixels(tracer.scene, pattern, transfer, blocks, tracer.target, results);
}

/// What finds the rays of samples that are traced again: all of them are followed ones.
FinderTable finders_to_trace_again(const Plan& plan) {
  Features features = plan.features;
  features.reflects = true;
  FinderTable finders = choose_finders(features, plan.statistics, plan.kernel.value, {});
  for (std::size_t kind = 0; kind < finders.size(); ++kind) {
    const auto of = [&](RayKind rays) -> Finder& {
      return finders[kind][static_cast<std::size_t>(rays)];
    };
    of(RayKind::from_eye) = Finder::none;
    // So few that a tree, which there is, costs less than grids of their own.
    const Finder planned = finder_of(plan.finders[kind], RayKind::to_soft_light);
    of(RayKind::to_soft_light) = planned == Finder::light_sweep ? of(RayKind::followed) : planned;
  }
  return finders;
}

/// What carries paths, and traces samples again if some are to be.
ExactScene make_exact_scene(const Plan& plan, const PackedScene& packed, WorkerPool& pool) {
  ExactScene exact;
  exact.carries_paths = are_paths_magnified(plan.statistics);
  const double nearest = nearest_in_single(plan.statistics);
  if (plan.statistics.nearest < nearest) exact.nearest = static_cast<float>(nearest);
  for (const LampDistances& lamp : plan.statistics.lamps) {
    const double reach = lamp_reach_in_single(lamp, plan.features, plan.statistics);
    if (std::isfinite(reach))
      exact.lamps.push_back({narrowed<float>(lamp.place), static_cast<float>(reach * reach)});
  }
  const FinderTable finders = exact.traces_again() ? finders_to_trace_again(plan) : FinderTable{};
  exact.scene = std::make_shared<const PacketScene<double>>(
      make_packet_scene<double>(packed, plan.features, finders, pool));
  return exact;
}

}  // namespace

Tracer make_tracer(const Plan& plan, PackedScene packed, WorkerPool& pool) {
  packed.light_sets = plan.light_sampling.value.sets;
  packed.sets_to_be_sure = plan.light_sampling.value.sets_to_be_sure;
  for (SoftLight& soft : packed.soft_lights)
    soft = place_samples(soft.light, plan.light_sampling.value);
  if (plan.kernel.value == Kernel::packets) {
    const std::int64_t target = plan.instruction_set.target;
    if (plan.precision.value == Precision::single_precision)
      return PacketTracer<float>{
          make_packet_scene<float>(packed, plan.features, plan.finders, pool), target};
    if (plan.precision.value == Precision::mixed) {
      PacketTracer<float> tracer{
          make_packet_scene<float>(packed, plan.features, plan.finders, pool), target};
      tracer.scene.exact = make_exact_scene(plan, packed, pool);
      return tracer;
    }
    return PacketTracer<double>{
        make_packet_scene<double>(packed, plan.features, plan.finders, pool), target};
  }
  auto kept = std::make_unique<const PackedScene>(std::move(packed));
  SingleRayFinder finder(*kept, plan.finders, pool);
  return ReferenceTracer{std::move(kept), std::move(finder)};
}

BeyondRange render_tile(const Tracer& tracer, const SamplePattern& pattern, const Tile& tile,
                        const TileOutput& output) {
  return std::visit([&](const auto& chosen) { return trace(chosen, pattern, tile, output); },
                    tracer);
}

bool render_tiles(const Tracer& tracer, const SamplePattern& pattern, std::span<const Tile> tiles,
                  const TileOutput& output, const TilePass& pass) {
  const auto each = [&](std::size_t i) {
    pass.finished(i, render_tile(tracer, pattern, tiles[i], output));
  };
  const auto render = [&](const auto& chosen) {
    if constexpr (requires { chosen.target; })
      if (chosen.scene.sweeps_soft_light)
        return render_swept(chosen.scene, chosen.target, pattern, tiles, output, pass);
    pass.pool.run(tiles.size(), each, pass.stop);
  };
  std::visit(render, tracer);
  return !pass.stop;
}

void sample_pixels(const Tracer& tracer, const SamplePattern& pattern, Transfer transfer,
                   std::span<const BlockPixels> blocks, std::span<SampledPixel> results) {
  std::visit([&](const auto& chosen) { sample(chosen, pattern, transfer, blocks, results); },
             tracer);
}

}  // namespace raytracer

// A scene made ready for one of the kernels: what traces tiles of it.
#pragma once

#include <memory>
#include <span>
#include <variant>

#include "engine/image/sampled_pixel.h"
#include "engine/image/tile.h"
#include "engine/image/tile_output.h"
#include "engine/kernel/beyond_range.h"
#include "engine/kernel/simd/render_tile.h"
#include "engine/kernel/simd/sample_pixels.h"
#include "engine/pack/packed_scene.h"
#include "engine/plan/plan.h"
#include "engine/reference/single_ray_finder.h"
#include "engine/render/tile_pass.h"

namespace raytracer {

/// The reference with what finds its primitives.
struct ReferenceTracer {
  std::unique_ptr<const PackedScene> scene;  ///< the finder refers to it
  SingleRayFinder finder;
};

/// Packets of rays in precision T.
template <typename T>
struct PacketTracer {
  PacketScene<T> scene;
  std::int64_t target;
};

using Tracer = std::variant<ReferenceTracer, PacketTracer<float>, PacketTracer<double>>;

/// Builds what the plan says, on the pool's threads. `packed` is the plan's scene.
Tracer make_tracer(const Plan& plan, PackedScene packed, WorkerPool& pool);

/// Traces the tile's pixels with one sample at each place of `pattern` and stores their encoded
/// means, and adds what they tell of its errors to `output.errors` if the pattern has half buffers.
/// Touches no other pixel and no other subtile.
BeyondRange render_tile(const Tracer& tracer, const SamplePattern& pattern, const Tile& tile,
                        const TileOutput& output);

/// The same for many tiles, in any order; false if `pass.stop` ended it. Where directions of soft
/// lights are swept, it takes far less than one tile after another.
bool render_tiles(const Tracer& tracer, const SamplePattern& pattern, std::span<const Tile> tiles,
                  const TileOutput& output, const TilePass& pass);

/// Samples single pixels of blocks at the places of a pattern that has half buffers and is not
/// jittered; `results` has one for each, block by block.
void sample_pixels(const Tracer& tracer, const SamplePattern& pattern, Transfer transfer,
                   std::span<const BlockPixels> blocks, std::span<SampledPixel> results);

}  // namespace raytracer

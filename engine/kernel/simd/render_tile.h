// The SIMD kernels' entry: a tile of the image, all samples of its pixels, on a chosen
// instruction set.
#pragma once

#include <cstdint>

#include "engine/image/tile.h"
#include "engine/image/tile_output.h"
#include "engine/kernel/beyond_range.h"
#include "engine/kernel/light_ledger.h"
#include "engine/kernel/packet_scene.h"
#include "engine/kernel/sample_point.h"

namespace raytracer {

struct TracedTile {
  std::int64_t target;  ///< of the code that ran, which is the one asked for if that is supported
  BeyondRange beyond;
};

/// Traces one sample at each place of `pattern` in each of the tile's pixels, and stores the means
/// of their clamped colours in `output`; and what they tell of its errors, if the pattern has half
/// buffers and somebody wants them. The tile begins at multiples of `block_side`. `ledger`, where
/// directions of soft lights are swept, tells what that came to.
TracedTile render_tile(const PacketScene<float>& scene, const SamplePattern& pattern,
                       const Tile& tile, std::int64_t target, const TileOutput& output,
                       LightLedger<float>* ledger = nullptr);
TracedTile render_tile(const PacketScene<double>& scene, const SamplePattern& pattern,
                       const Tile& tile, std::int64_t target, const TileOutput& output,
                       LightLedger<double>* ledger = nullptr);

/// Writes down in `ledger` what the same samples ask of soft lights, in the order in which
/// render_tile() asks.
void record_tile(const PacketScene<float>& scene, const SamplePattern& pattern, const Tile& tile,
                 std::int64_t target, LightLedger<float>& ledger);
void record_tile(const PacketScene<double>& scene, const SamplePattern& pattern, const Tile& tile,
                 std::int64_t target, LightLedger<double>& ledger);

}  // namespace raytracer

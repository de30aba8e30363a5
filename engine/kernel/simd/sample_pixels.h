// The SIMD kernels' other entry: single pixels of a block.
//
// Few of a block's pixels need many samples, and seldom as many as each other: a packet has one
// pixel's samples, which meet the same things. Under soft lights, to which most rays go, it has one
// sample of many pixels, as those that use the same places on them do.
#pragma once

#include <cstdint>
#include <span>

#include "engine/image/sampled_pixel.h"
#include "engine/kernel/packet_scene.h"
#include "engine/kernel/sample_point.h"
#include "engine/math/transfer.h"

namespace raytracer {

/// Traces one sample at each place of `pattern`, which has half buffers, in each of the
/// blocks' pixels, and leaves what they come to after `transfer` in `results`, one for
/// each, block by block.
void sample_pixels(const PacketScene<float>& scene, const SamplePattern& pattern, Transfer transfer,
                   std::span<const BlockPixels> blocks, std::int64_t target,
                   std::span<SampledPixel> results);
void sample_pixels(const PacketScene<double>& scene, const SamplePattern& pattern,
                   Transfer transfer, std::span<const BlockPixels> blocks, std::int64_t target,
                   std::span<SampledPixel> results);

}  // namespace raytracer

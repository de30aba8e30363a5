// The SIMD kernels' other entry: single pixels of a block, whose samples are traced side by side.
//
// Few of a block's pixels need many samples, and seldom as many as each other: a packet has one
// pixel's samples, which meet the same things.
#pragma once

#include <cstdint>
#include <span>

#include "engine/image/sampled_pixel.h"
#include "engine/kernel/packet_scene.h"
#include "engine/kernel/sample_point.h"
#include "engine/math/transfer.h"

namespace raytracer {

/// Traces one sample at each place of `pattern`, which has half buffers and is not jittered, in
/// each of the pixels, and leaves what they come to after `transfer` in `results`, one for each.
void sample_pixels(const PacketScene<float>& scene, const SamplePattern& pattern, Transfer transfer,
                   const BlockPixels& pixels, std::int64_t target, std::span<SampledPixel> results);
void sample_pixels(const PacketScene<double>& scene, const SamplePattern& pattern,
                   Transfer transfer, const BlockPixels& pixels, std::int64_t target,
                   std::span<SampledPixel> results);

}  // namespace raytracer

// The SIMD kernels' entry: a block of pixels, one sample of each, on a chosen instruction set.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/kernel/simd/simd_scene.h"
#include "engine/plan/machine.h"

namespace raytracer {

inline constexpr int block_pixels = block_side * block_side;

/// Pixels begin <= (x, y) < begin + size, y = 0 on top, at most `block_side` either way.
struct PixelBlock {
  int x_begin;
  int y_begin;
  int width;
  int height;
};

/// Sums of samples of a block's pixels, row by row.
template <typename T>
struct BlockSums {
  alignas(64) T red[block_pixels];
  alignas(64) T green[block_pixels];
  alignas(64) T blue[block_pixels];
};

/// What this machine can run of what was compiled, best first.
std::vector<InstructionSet> supported_instruction_sets();

/// The machine that this process runs on.
Machine this_machine();

/// Traces the sample at (sample_x, sample_y), in pixels right and up, of each of the block's
/// pixels, and adds its clamped colour to `sums`. The block is one of the scene's bins.
/// Returns the target of the code that ran, which is the one asked for if that is supported.
std::int64_t render_block(const SimdScene<float>& scene, const PixelBlock& block, double sample_x,
                          double sample_y, std::int64_t target, BlockSums<float>& sums);
std::int64_t render_block(const SimdScene<double>& scene, const PixelBlock& block, double sample_x,
                          double sample_y, std::int64_t target, BlockSums<double>& sums);

}  // namespace raytracer

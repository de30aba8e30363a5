// The coarsest picture: a subtile stands for its block, or for several blocks where there is no
// time for more.
//
// Blocks are traced from coarse to fine: every eighth in both directions (of small images every
// fourth, second or each, so that there are some), then the fourths between them, and so on until
// each has a subtile, which takes a sixteenth of the time of all pixels, or the budget is spent.
// However short it is, the coarsest are done, and all pixels of an image of very few blocks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/tile.h"
#include "engine/math/block.h"
#include "engine/render/tracing.h"

namespace raytracer {

/// Of how many blocks there are subtiles at least, if the image has them.
inline constexpr std::size_t least_coarse_blocks = 64;
/// So few do not tell each other's errors, and take no longer than the first ones of others: all of
/// their pixels are traced.
constexpr bool are_few_blocks(std::size_t blocks) {
  return blocks <= least_coarse_blocks / std::size_t{subtiles_in_block};
}

/// The share of an image's pixels that is traced however short the budget is.
double coarsest_share(int width, int height);

/// With one sample per pixel, where that was traced.
struct CoarsePicture {
  Image image;
  /// How many blocks across are shown by the subtile that stands for a block, row by row: 1 if that
  /// is its own; 0 if every pixel is traced.
  std::vector<std::uint8_t> coarseness;
  std::vector<float> subtile_ms;  ///< that each block's own subtile took one thread

  /// Whether no block is coarser.
  bool is_at_most(int most) const;
};

/// Leaves `after_ms` of the budget. Nothing if it was stopped before there was a picture.
std::optional<CoarsePicture> trace_coarse_picture(Tracing& tracing, double after_ms);

/// Traces a tile into an image with one sample per pixel.
BeyondRange trace_once(const Tracing& tracing, const Tile& tile, Image& image);

/// The squared errors, the sum over the channels, that the subtiles of a block of a `coarseness`
/// probably have.
std::array<double, subtiles_in_block> guess_errors2(const Image& image, const Tile& block,
                                                    int coarseness);

}  // namespace raytracer

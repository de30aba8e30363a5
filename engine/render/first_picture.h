// The first picture under a budget: coarser than a sample per pixel where time is that short.
//
// First a subtile of each block is traced and stands for the whole block, which takes a sixteenth
// of the time; then the other subtiles, block by block, until they are done or the time is over.
// However short the budget, the first half is done.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/tile.h"
#include "engine/math/block.h"
#include "engine/render/tracing.h"

namespace raytracer {

struct FirstPicture {
  Image image;
  std::vector<char> is_traced;  ///< of each block, row by row: every pixel, not one subtile for all
  bool is_whole = false;        ///< all blocks are traced
};

/// With one sample per pixel. Nothing if it was stopped before there was a picture.
std::optional<FirstPicture> trace_first_picture(Tracing& tracing);

/// The squared errors that the subtiles of a block probably have with one sample per pixel, or one
/// subtile for all.
std::array<double, subtiles_in_block> guess_errors2(const Image& image, const Tile& block,
                                                    bool is_traced);

}  // namespace raytracer

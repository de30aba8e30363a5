// The first picture under a budget: coarser than a sample per pixel where time is that short.
//
// First a part of each block is traced and stands for the whole block, which takes a sixteenth of
// the time; then the other parts, block by block, until they are done or the time is over. However
// short the budget, the first half is done.
#pragma once

#include <optional>
#include <vector>

#include "engine/image/image.h"
#include "engine/render/tracing.h"

namespace raytracer {

struct FirstPicture {
  Image image;
  std::vector<char> is_traced;  ///< of each block, row by row: every pixel, not one part for all
  bool is_whole = false;        ///< all blocks are traced
};

/// With one sample per pixel. Nothing if it was stopped before there was a picture.
std::optional<FirstPicture> trace_first_picture(Tracing& tracing);

/// The squared error that one part for all probably leaves in a pixel of this block, its channels'
/// sum: what varies within that part, and its difference from the blocks beside it.
double coarse_error2(const Image& image, int column, int row);

}  // namespace raytracer

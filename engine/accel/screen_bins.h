// Which spheres and triangles each block of pixels may show, near to far.
//
// All rays from the eye share their origin, so a 2-D structure finds what they meet: the image,
// cut into blocks. Every primitive is entered into the blocks that its silhouette may touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/binning.h"
#include "engine/pack/packed_scene.h"
#include "engine/pack/view.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// A sphere or triangle in a block.
struct ScreenEntry {
  float nearest;            ///< a lower bound of its distance from the eye
  std::uint32_t primitive;  ///< index into the spheres or triangles
  /// Which of the block's parts it may touch: bit parts_across * row + column, row 0 on top.
  std::uint16_t parts;
};

/// Entries by block, blocks row by row from the top.
struct ScreenBins {
  BinGrid blocks{};
  std::vector<std::uint32_t> begins;  ///< of each block in `spheres`, and the end of the last
  LargeArray<ScreenEntry> spheres;
  std::vector<std::uint32_t> triangle_begins;  ///< of each block in `triangles`, likewise
  LargeArray<ScreenEntry> triangles;           ///< none unless they are to be found here
  std::vector<std::uint16_t> squares;          ///< the parts of each block that may show a square

  /// The parts of the block at (column, row) that may show a square, as ScreenEntry::parts.
  std::uint16_t square_parts(int column, int row) const {
    return squares.empty() ? 0 : squares[blocks.index(column, row)];
  }

  /// The spheres of the block at (column, row), nearest first.
  std::span<const ScreenEntry> block(int column, int row) const {
    const std::uint32_t begin = begins[blocks.index(column, row)];
    return std::span(spheres).subspan(begin, begins[blocks.index(column, row) + 1] - begin);
  }

  /// Its triangles, nearest first.
  std::span<const ScreenEntry> block_triangles(int column, int row) const {
    if (triangles.empty()) return {};
    const std::uint32_t begin = triangle_begins[blocks.index(column, row)];
    const std::uint32_t end = triangle_begins[blocks.index(column, row) + 1];
    return std::span(triangles).subspan(begin, end - begin);
  }
};

/// Uses the pool's threads.
ScreenBins build_screen_bins(const View& view, std::span<const PackedSphere> spheres,
                             const std::vector<PackedSquare>& squares,
                             std::span<const PackedTriangle> triangles, WorkerPool& pool);

}  // namespace raytracer

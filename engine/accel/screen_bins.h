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
#include "engine/parallel/worker_pool.h"
#include "engine/plan/view.h"

namespace raytracer {

/// A sphere or triangle in a block.
struct ScreenEntry {
  float nearest;            ///< a lower bound of its distance from the eye
  std::uint32_t primitive;  ///< a sphere's number; a triangle's index into the triangles
};

/// Those of a block, nearest first.
struct BlockEntries {
  std::span<const ScreenEntry> entries;
  /// Which of the block's parts each may touch: bit parts_across * row + column, row 0 on top.
  /// Vectors that begin with any of them may be read.
  const std::uint16_t* parts = nullptr;
};

/// Entries by block, blocks row by row from the top. What an entry may touch is kept apart, so that
/// many are looked through at once.
struct ScreenLists {
  std::vector<std::uint32_t> begins;  ///< of each block, and the end of the last
  LargeArray<ScreenEntry> entries;
  LargeArray<std::uint16_t> parts;  ///< as in BlockEntries

  bool empty() const { return entries.empty(); }
  BlockEntries block(std::size_t index) const {
    const std::uint32_t begin = begins[index];
    return {std::span(entries).subspan(begin, begins[index + 1] - begin), parts.data() + begin};
  }
};

struct ScreenBins {
  BinGrid blocks{};
  ScreenLists spheres;
  ScreenLists triangles;               ///< none unless they are to be found here
  std::vector<std::uint16_t> squares;  ///< the parts of each block that may show a square

  /// The parts of the block at (column, row) that may show a square, as in BlockEntries.
  std::uint16_t square_parts(int column, int row) const {
    return squares.empty() ? 0 : squares[blocks.index(column, row)];
  }

  /// The spheres of the block at (column, row), nearest first.
  BlockEntries block(int column, int row) const { return spheres.block(blocks.index(column, row)); }

  /// Its triangles, nearest first.
  BlockEntries block_triangles(int column, int row) const {
    return triangles.empty() ? BlockEntries{} : triangles.block(blocks.index(column, row));
  }
};

/// `numbers` are those of the scene. Uses the pool's threads.
ScreenBins build_screen_bins(const View& view, std::span<const PackedSphere> spheres,
                             const Numbering& numbers, const std::vector<PackedSquare>& squares,
                             std::span<const PackedTriangle> triangles, WorkerPool& pool);

}  // namespace raytracer

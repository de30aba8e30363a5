// The pieces of an image that threads work on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/image/image.h"
#include "engine/math/block.h"

namespace raytracer {

/// Pixels begin <= (x, y) < end, y = 0 on top.
///
/// Only those of `subtiles` count: the subtiles of each block, from the tile's begin on, are
/// numbered row by row. And only blocks that are `block_step` pixels from one another.
struct Tile {
  int x_begin;
  int y_begin;
  int x_end;
  int y_end;
  std::uint16_t subtiles = all_subtiles;
  int block_step = block_side;

  static constexpr std::uint16_t all_subtiles = 0xFFFF;
  static constexpr std::uint16_t first_subtile = 1;  ///< that blocks at the image's rims have, too

  int width() const { return x_end - x_begin; }
  int height() const { return y_end - y_begin; }
  std::size_t pixel_count() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }

  /// The subtile that (x, y) is in.
  int subtile_of(int x, int y) const {
    return subtile_index((x - x_begin) % block_side, (y - y_begin) % block_side);
  }
};

/// Copies all of the tile's pixels from one image into another of its size.
void copy_tile(const Image& from, const Tile& tile, Image& to);

/// All of an image.
inline Tile whole_image(int width, int height) { return {0, 0, width, height}; }

/// The tiles that cover an area, each at most `side` pixels wide and high, row by row.
std::vector<Tile> split_into_tiles(const Tile& area, int side);
/// Those that cover an image.
std::vector<Tile> split_into_tiles(int width, int height, int side);

}  // namespace raytracer

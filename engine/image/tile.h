// The pieces of an image that threads work on.
#pragma once

#include <vector>

namespace raytracer {

/// Pixels begin <= (x, y) < end, y = 0 on top.
struct Tile {
  int x_begin;
  int y_begin;
  int x_end;
  int y_end;
};

/// The tiles that cover an image, each at most `side` pixels wide and high, row by row.
std::vector<Tile> split_into_tiles(int width, int height, int side);

}  // namespace raytracer

#include "engine/image/tile.h"

#include <algorithm>

namespace raytracer {

std::vector<Tile> split_into_tiles(int width, int height, int side) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += side)
    for (int x = 0; x < width; x += side)
      tiles.push_back({x, y, std::min(x + side, width), std::min(y + side, height)});
  return tiles;
}

void copy_tile(const Image& from, const Tile& tile, Image& to) {
  for (int y = tile.y_begin; y < tile.y_end; ++y)
    std::copy_n(from.pixel(tile.x_begin, y),
                3 * static_cast<std::ptrdiff_t>(tile.x_end - tile.x_begin),
                to.pixel(tile.x_begin, y));
}

}  // namespace raytracer

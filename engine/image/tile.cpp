#include "engine/image/tile.h"

#include <algorithm>

namespace raytracer {

std::vector<Tile> split_into_tiles(const Tile& area, int side) {
  std::vector<Tile> tiles;
  for (int y = area.y_begin; y < area.y_end; y += side)
    for (int x = area.x_begin; x < area.x_end; x += side)
      tiles.push_back({x, y, std::min(x + side, area.x_end), std::min(y + side, area.y_end)});
  return tiles;
}

std::vector<Tile> split_into_tiles(int width, int height, int side) {
  return split_into_tiles(whole_image(width, height), side);
}

void copy_tile(const Image& from, const Tile& tile, Image& to) {
  for (int y = tile.y_begin; y < tile.y_end; ++y)
    std::copy_n(from.pixel(tile.x_begin, y), from.length_of(tile.width()),
                to.pixel(tile.x_begin, y));
}

}  // namespace raytracer

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

}  // namespace raytracer

// One tile of an image, traced.
#pragma once

#include <variant>
#include <vector>

#include "engine/accel/brute_force.h"
#include "engine/accel/bvh.h"
#include "engine/image/image.h"
#include "engine/kernel/packed_scene.h"
#include "engine/sample/pattern.h"
#include "engine/scene/scene.h"

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

/// Whatever finds the primitives on a ray's way.
using Structure = std::variant<BruteForce, Bvh>;

/// Traces the tile's pixels with one sample at each place of `pattern` and stores their encoded
/// means. Touches no other pixel.
void render_tile(const PackedScene& scene, const Structure& structure,
                 const std::vector<SamplePoint>& pattern, Transfer transfer, const Tile& tile,
                 Image& image);

}  // namespace raytracer

#include "engine/render/tile.h"

#include <algorithm>

#include "engine/image/transfer.h"
#include "engine/kernel/radiance.h"

namespace raytracer {
namespace {

Rgb clamped(const Rgb& c) {
  return {std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)};
}

}  // namespace

std::vector<Tile> split_into_tiles(int width, int height, int side) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += side)
    for (int x = 0; x < width; x += side)
      tiles.push_back({x, y, std::min(x + side, width), std::min(y + side, height)});
  return tiles;
}

void render_tile(const PackedScene& scene, const Structure& structure,
                 const std::vector<SamplePoint>& pattern, Transfer transfer, const Tile& tile,
                 Image& image) {
  std::visit(
      [&](const auto& chosen) {
        for (int y = tile.y_begin; y < tile.y_end; ++y) {
          for (int x = tile.x_begin; x < tile.x_end; ++x) {
            Rgb sum;
            for (const SamplePoint& sample : pattern)
              sum += clamped(
                  radiance(scene, chosen,
                           scene.view.direction(x + sample.x, image.height - 1 - y + sample.y)));
            const Rgb mean = sum / static_cast<double>(pattern.size());
            float* pixel = image.pixel(x, y);
            pixel[0] = static_cast<float>(encode_channel(mean.x, transfer));
            pixel[1] = static_cast<float>(encode_channel(mean.y, transfer));
            pixel[2] = static_cast<float>(encode_channel(mean.z, transfer));
          }
        }
      },
      structure);
}

}  // namespace raytracer

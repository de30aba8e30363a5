#include "engine/render/first_picture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace raytracer {
namespace {

constexpr std::uint16_t first_part = 1;  // the one that blocks at the image's rims have, too
constexpr std::uint16_t other_parts = Tile::all_parts ^ first_part;

struct Pixels {
  int x_begin;
  int y_begin;
  int x_end;
  int y_end;

  int count() const { return (x_end - x_begin) * (y_end - y_begin); }
};

Pixels pixels_of(const Image& image, int column, int row, int side) {
  const int x = column * block_side;
  const int y = row * block_side;
  return {x, y, std::min(x + side, image.width), std::min(y + side, image.height)};
}

Rgb mean_of(const Image& image, const Pixels& pixels) {
  Rgb sum;
  for (int y = pixels.y_begin; y < pixels.y_end; ++y)
    for (int x = pixels.x_begin; x < pixels.x_end; ++x) {
      const float* const pixel = image.pixel(x, y);
      sum += Rgb{pixel[0], pixel[1], pixel[2]};
    }
  return sum / static_cast<double>(pixels.count());
}

/// Has the first part of each block of the tile stand for the block.
void spread_first_parts(const Tile& tile, Image& image) {
  for (int y = tile.y_begin; y < tile.y_end; y += block_side) {
    for (int x = tile.x_begin; x < tile.x_end; x += block_side) {
      const int column = x / block_side;
      const int row = y / block_side;
      const Rgb mean = mean_of(image, pixels_of(image, column, row, part_side));
      const std::array color{static_cast<float>(mean.x), static_cast<float>(mean.y),
                             static_cast<float>(mean.z)};
      const Pixels block = pixels_of(image, column, row, block_side);
      for (int to_y = block.y_begin; to_y < block.y_end; ++to_y)
        for (int to_x = block.x_begin; to_x < block.x_end; ++to_x)
          if (to_x >= x + part_side || to_y >= y + part_side)
            std::copy(color.begin(), color.end(), image.pixel(to_x, to_y));
    }
  }
}

}  // namespace

std::optional<FirstPicture> trace_first_picture(Tracing& tracing) {
  const Camera& camera = tracing.scene.camera;
  const auto columns = static_cast<std::size_t>((camera.width + block_side - 1) / block_side);
  const auto rows = static_cast<std::size_t>((camera.height + block_side - 1) / block_side);
  FirstPicture first{Image(camera.width, camera.height), std::vector<char>(columns * rows, 0)};
  const SamplePattern pattern = sample_pattern(1);
  const std::vector<Tile> tiles =
      split_into_tiles(camera.width, camera.height, tracing.plan.tile_side_px.value);
  std::vector<BeyondRange> beyond(tiles.size());
  std::atomic<bool> stop{false};
  const auto trace = [&](std::size_t i, std::uint16_t parts) {
    Tile tile = tiles[i];
    tile.parts = parts;
    beyond[i] +=
        render_tile(tracing.tracer, pattern, tracing.scene.render.transfer, tile, &first.image);
  };
  tracing.pool.run(
      tiles.size(),
      [&](std::size_t i) {
        if (tracing.progress.stop) stop = true;
        if (stop) return;
        trace(i, first_part);
        spread_first_parts(tiles[i], first.image);
      },
      stop);
  if (stop) return {};

  // Its errors are looked at afterwards.
  constexpr double look_at_pixel_ms = 4e-6;
  const double look_ms = look_at_pixel_ms * camera.width * camera.height /
                         static_cast<double>(tracing.pool.thread_count());
  const std::size_t at_once = std::min(tracing.pool.thread_count(), tiles.size());
  const double tile_ms = tracing.watch.elapsed_ms() * (parts_in_block - 1) *
                         static_cast<double>(at_once) / static_cast<double>(tiles.size());
  tracing.pool.run(
      tiles.size(),
      [&](std::size_t i) {
        if (tracing.progress.stop || tracing.is_over_time(tile_ms + look_ms)) stop = true;
        if (stop) return;
        trace(i, other_parts);
        const Tile& tile = tiles[i];
        for (int y = tile.y_begin; y < tile.y_end; y += block_side)
          for (int x = tile.x_begin; x < tile.x_end; x += block_side)
            first.is_traced[static_cast<std::size_t>(y / block_side) * columns +
                            static_cast<std::size_t>(x / block_side)] = 1;
      },
      stop);
  if (tracing.progress.stop) return {};
  for (const BeyondRange& in_tile : beyond) tracing.beyond += in_tile;
  first.is_whole = !stop;
  ++tracing.passes_done;
  return first;
}

double coarse_error2(const Image& image, int column, int row) {
  const Pixels part = pixels_of(image, column, row, part_side);
  const Rgb mean = mean_of(image, part);
  const auto square = [](const Rgb& c) { return dot(c, c); };
  double within = 0;
  for (int y = part.y_begin; y < part.y_end; ++y)
    for (int x = part.x_begin; x < part.x_end; ++x) {
      const float* const pixel = image.pixel(x, y);
      within += square(Rgb{pixel[0], pixel[1], pixel[2]} - mean);
    }
  double beside = 0;
  const auto compare = [&](int other_column, int other_row) {
    if (other_column < 0 || other_row < 0 || other_column * block_side >= image.width ||
        other_row * block_side >= image.height)
      return;
    beside = std::max(
        beside,
        square(mean_of(image, pixels_of(image, other_column, other_row, part_side)) - mean));
  };
  compare(column - 1, row);
  compare(column + 1, row);
  compare(column, row - 1);
  compare(column, row + 1);
  return within / part.count() + beside / 2;
}

}  // namespace raytracer

#include "engine/render/first_picture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

#include "engine/errors/error_model.h"
#include "engine/sample/neighbour_error.h"
#include "engine/sample/pattern.h"

namespace raytracer {
namespace {

constexpr std::uint16_t first_subtile = 1;  // the one that blocks at the image's rims have, too
constexpr std::uint16_t other_subtiles = Tile::all_subtiles ^ first_subtile;

/// The first `side` x `side` pixels of a block, those in the image.
Tile corner_of(const Image& image, int x, int y, int side) {
  return {x, y, std::min(x + side, image.width), std::min(y + side, image.height)};
}

int count_pixels(const Tile& tile) {
  return (tile.x_end - tile.x_begin) * (tile.y_end - tile.y_begin);
}

int count_blocks(const Tile& tile) {
  const auto along = [](int pixels) { return (pixels + block_side - 1) / block_side; };
  return along(tile.x_end - tile.x_begin) * along(tile.y_end - tile.y_begin);
}

/// Calls visit(x, y) for the pixels, or those that begin squares of `step` pixels.
template <typename Visit>
void for_each_pixel(const Tile& tile, int step, const Visit& visit) {
  for (int y = tile.y_begin; y < tile.y_end; y += step)
    for (int x = tile.x_begin; x < tile.x_end; x += step) visit(x, y);
}

/// The values of a pixel; of three channels, the fourth is 0.
using Values = std::array<double, 4>;

Values values_at(const Image& image, int x, int y) {
  Values values{};
  std::copy_n(image.pixel(x, y), image.channels, values.begin());
  return values;
}

double squared_distance(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// Of the first subtile of the block that begins at (x, y).
Values subtile_mean(const Image& image, int x, int y) {
  const Tile subtile = corner_of(image, x, y, subtile_side);
  Values mean{};
  for_each_pixel(subtile, 1, [&](int at_x, int at_y) {
    const Values values = values_at(image, at_x, at_y);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += values[i];
  });
  for (double& value : mean) value /= count_pixels(subtile);
  return mean;
}

/// Has the first subtile of each block of the tile stand for the block.
void spread_first_subtiles(const Tile& tile, Image& image) {
  for_each_pixel(tile, block_side, [&](int x, int y) {
    const Values mean = subtile_mean(image, x, y);
    for_each_pixel(corner_of(image, x, y, block_side), 1, [&](int to_x, int to_y) {
      if (to_x >= x + subtile_side || to_y >= y + subtile_side)
        std::transform(mean.begin(), mean.begin() + image.channels, image.pixel(to_x, to_y),
                       [](double value) { return static_cast<float>(value); });
    });
  });
}

/// The squared error that one subtile for all probably leaves in a pixel of the block that begins
/// at (x, y), its channels' sum: what varies within that subtile, and its difference from the
/// blocks beside it.
double coarse_error2(const Image& image, int x, int y) {
  const Values mean = subtile_mean(image, x, y);
  const Tile subtile = corner_of(image, x, y, subtile_side);
  double within = 0;
  for_each_pixel(subtile, 1, [&](int at_x, int at_y) {
    within += squared_distance(values_at(image, at_x, at_y), mean);
  });
  double beside = 0;
  const auto compare = [&](int at_x, int at_y) {
    if (at_x >= 0 && at_y >= 0 && at_x < image.width && at_y < image.height)
      beside = std::max(beside, squared_distance(subtile_mean(image, at_x, at_y), mean));
  };
  compare(x - block_side, y);
  compare(x + block_side, y);
  compare(x, y - block_side);
  compare(x, y + block_side);
  return within / count_pixels(subtile) + SampleErrorModel::block_neighbour_share * beside;
}

}  // namespace

std::optional<FirstPicture> trace_first_picture(Tracing& tracing) {
  const Camera& camera = tracing.scene.camera;
  const auto columns = static_cast<std::size_t>((camera.width + block_side - 1) / block_side);
  const auto rows = static_cast<std::size_t>((camera.height + block_side - 1) / block_side);
  FirstPicture first{Image(camera.width, camera.height, channel_count(tracing.scene)),
                     std::vector<char>(columns * rows, 0)};
  const SamplePattern pattern = sample_pattern(1);
  const std::vector<Tile> tiles =
      split_into_tiles(camera.width, camera.height, tracing.plan.tile_side_px.value);
  std::vector<BeyondRange> beyond(tiles.size());
  std::vector<double> block_ms(tiles.size());  // that the rest of a tile's block probably takes
  std::atomic<bool> stop{false};
  const auto trace = [&](std::size_t i, Tile tile, std::uint16_t subtiles) {
    tile.subtiles = subtiles;
    beyond[i] +=
        render_tile(tracing.tracer, pattern, tracing.scene.render.transfer, tile, &first.image);
  };
  tracing.pool.run(
      tiles.size(),
      [&](std::size_t i) {
        if (tracing.progress.stop) stop = true;
        if (stop) return;
        // By the clock a tile whose thread had to wait would be left as it is.
        const ThreadStopwatch watch;
        trace(i, tiles[i], first_subtile);
        block_ms[i] = watch.elapsed_ms() * (subtiles_in_block - 1) / count_blocks(tiles[i]);
        spread_first_subtiles(tiles[i], first.image);
      },
      stop);
  if (stop) return {};

  std::atomic<bool> is_whole{true};
  const std::size_t at_once = std::min(tracing.pool.thread_count(), tiles.size());
  const double rounds = static_cast<double>(tiles.size()) / static_cast<double>(at_once);
  // Its errors are guessed afterwards: as long for each tile as for the first.
  const Stopwatch guessing;
  for_each_pixel(tiles[0], block_side, [&](int x, int y) {
    guess_errors2(first.image, corner_of(first.image, x, y, block_side), true);
  });
  const double guess_ms = guessing.elapsed_ms() * rounds;
  tracing.pool.run(
      tiles.size(),
      [&](std::size_t i) {
        for_each_pixel(tiles[i], block_side, [&](int x, int y) {
          if (tracing.progress.stop || tracing.is_over_time(guess_ms)) stop = true;
          if (stop) return;
          if (tracing.is_over_time(block_ms[i] + guess_ms)) {  // others may not take so long
            is_whole = false;
            return;
          }
          trace(i, corner_of(first.image, x, y, block_side), other_subtiles);
          first.is_traced[static_cast<std::size_t>(y / block_side) * columns +
                          static_cast<std::size_t>(x / block_side)] = 1;
        });
      },
      stop);
  if (tracing.progress.stop) return {};
  for (const BeyondRange& in_tile : beyond) tracing.beyond += in_tile;
  first.is_whole = is_whole && !stop;
  ++tracing.passes_done;
  return first;
}

std::array<double, subtiles_in_block> guess_errors2(const Image& image, const Tile& block,
                                                    bool is_traced) {
  std::array<double, subtiles_in_block> errors2{};
  const double coarse = is_traced ? 0 : coarse_error2(image, block.x_begin, block.y_begin);
  for_each_pixel(block, subtile_side, [&](int x, int y) {
    const Tile subtile = corner_of(image, x, y, subtile_side);
    errors2[static_cast<std::size_t>(block.subtile_of(x, y))] =
        is_traced ? neighbour_error2(image, subtile) : coarse * count_pixels(subtile);
  });
  return errors2;
}

}  // namespace raytracer

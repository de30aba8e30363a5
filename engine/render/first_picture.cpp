#include "engine/render/first_picture.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "engine/math/block.h"
#include "engine/measure/stopwatch.h"

namespace raytracer {
namespace {

constexpr std::uint16_t other_subtiles = Tile::all_subtiles ^ Tile::first_subtile;

/// Calls visit(block) for the tile's blocks, the parts of them that are in it.
template <typename Visit>
void for_each_block(const Tile& tile, const Visit& visit) {
  for (int y = tile.y_begin; y < tile.y_end; y += block_side)
    for (int x = tile.x_begin; x < tile.x_end; x += block_side)
      visit(Tile{x, y, std::min(x + block_side, tile.x_end), std::min(y + block_side, tile.y_end)});
}

/// How long it will take to guess the errors of all blocks, if each tile takes as long as the
/// first.
double measure_guessing(const Tracing& tracing, const std::vector<Tile>& tiles) {
  const Image image(tiles[0].x_end, tiles[0].y_end, channel_count(tracing.scene));
  const auto guess = [&](const Tile& block) { guess_errors2(image, block, 0); };
  for_each_block(tiles[0], guess);  // fresh memory is slow, and the picture's will not be fresh
  const ThreadStopwatch watch;
  for_each_block(tiles[0], guess);
  const std::size_t at_once = std::min(tracing.pool.thread_count(), tiles.size());
  return watch.elapsed_ms() * static_cast<double>(tiles.size()) / static_cast<double>(at_once);
}

}  // namespace

std::optional<CoarsePicture> trace_first_picture(Tracing& tracing) {
  const Camera& camera = tracing.scene.camera;
  const std::vector<Tile> tiles =
      split_into_tiles(camera.width, camera.height, tracing.plan.tile_side_px.value);
  const double guess_ms = measure_guessing(tracing, tiles);
  std::optional<CoarsePicture> picture = trace_coarse_picture(tracing, guess_ms);
  if (!picture || !picture->is_at_most(1)) return picture;

  const std::size_t columns = blocks_along(camera.width);
  const bool is_small = are_few_blocks(picture->coarseness.size());
  std::vector<BeyondRange> beyond(tiles.size());
  std::atomic<bool> stop{false};
  tracing.pool.run(
      tiles.size(),
      [&](std::size_t i) {
        for_each_block(tiles[i], [&](Tile block) {
          if (tracing.progress.stop || (!is_small && tracing.is_over_time(guess_ms))) stop = true;
          if (stop) return;
          const std::size_t index = block_index(block.x_begin, block.y_begin, columns);
          const double expected_ms =
              static_cast<double>(picture->subtile_ms[index]) * (subtiles_in_block - 1);
          // Others may not take so long.
          if (!is_small && tracing.is_over_time(expected_ms + guess_ms)) return;
          block.subtiles = other_subtiles;
          beyond[i] += trace_once(tracing, block, picture->image);
          picture->coarseness[index] = 0;
          tracing.report(0);
        });
      },
      stop);
  if (tracing.progress.stop) return {};
  for (const BeyondRange& in_tile : beyond) tracing.beyond += in_tile;
  return picture;
}

}  // namespace raytracer

#include "engine/render/coarse_picture.h"

#include <algorithm>
#include <atomic>

#include "engine/errors/error_model.h"
#include "engine/sample/neighbour_error.h"
#include "engine/sample/pattern.h"

namespace raytracer {
namespace {

/// Of the blocks that are traced however short the budget is: how far they are from one another at
/// most, in blocks.
constexpr int coarsest = 8;
/// Blocks that a thread traces between two looks at the clock, at most.
constexpr int blocks_at_once = 16;

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

/// Calls visit(x, y) for the pixels, or those that begin squares of `step` pixels.
template <typename Visit>
void for_each_pixel(const Tile& tile, int step, const Visit& visit) {
  for (int y = tile.y_begin; y < tile.y_end; y += step)
    for (int x = tile.x_begin; x < tile.x_end; x += step) visit(x, y);
}

/// The first `side` x `side` pixels of the block that begins at (x, y), those in the image.
Tile corner_of(const Image& image, int x, int y, int side) {
  return {x, y, std::min(x + side, image.width), std::min(y + side, image.height)};
}

double count_pixels(const Tile& tile) { return static_cast<double>(tile.pixel_count()); }

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

/// Where the block begins whose subtile stands for the one at x, or y.
int origin_of(int x, int coarseness) {
  const int side = std::max(coarseness, 1) * block_side;
  return x / side * side;
}

/// The squared error that one subtile for all probably leaves in a pixel of the block that begins
/// at (x, y), its channels' sum: what varies within that subtile, and its difference from those
/// beside it.
double coarse_error2(const Image& image, int x, int y, int coarseness) {
  const int from_x = origin_of(x, coarseness);
  const int from_y = origin_of(y, coarseness);
  const Values mean = subtile_mean(image, from_x, from_y);
  const Tile subtile = corner_of(image, from_x, from_y, subtile_side);
  double within = 0;
  for_each_pixel(subtile, 1, [&](int at_x, int at_y) {
    within += squared_distance(values_at(image, at_x, at_y), mean);
  });
  double beside = 0;
  const auto compare = [&](int at_x, int at_y) {
    if (at_x >= 0 && at_y >= 0 && at_x < image.width && at_y < image.height)
      beside = std::max(beside, squared_distance(subtile_mean(image, at_x, at_y), mean));
  };
  const int step = coarseness * block_side;
  compare(from_x - step, from_y);
  compare(from_x + step, from_y);
  compare(from_x, from_y - step);
  compare(from_x, from_y + step);
  return within / count_pixels(subtile) + SampleErrorModel::block_neighbour_share * beside;
}

/// The coarsest step, in blocks.
int first_step(const Image& image) {
  const auto blocks = [&](int step) {
    const auto along = [step](int pixels) {
      return (blocks_along(pixels) + static_cast<std::size_t>(step) - 1) /
             static_cast<std::size_t>(step);
    };
    return along(image.width) * along(image.height);
  };
  int step = coarsest;
  while (step > 1 && blocks(step) < least_coarse_blocks) step /= 2;
  return step;
}

/// The blocks that begin at multiples of `step` blocks and, unless these are the first, at none of
/// twice that: in rows of at most `blocks_at_once`.
std::vector<Tile> rows_of_blocks(const Image& image, int step, bool are_first) {
  std::vector<Tile> rows;
  const auto add = [&](int x_from, int y_from, int stride) {
    const int length = stride * blocks_at_once;
    for (int y = y_from; y < image.height; y += stride)
      for (int x = x_from; x < image.width; x += length)
        rows.push_back({x, y, std::min(x + length, image.width),
                        std::min(y + block_side, image.height), Tile::first_subtile, stride});
  };
  const int side = step * block_side;
  if (are_first) {
    add(0, 0, side);
  } else {
    add(side, 0, 2 * side);
    add(0, side, 2 * side);
    add(side, side, 2 * side);
  }
  return rows;
}

/// Traces blocks' first subtiles, level by level.
class CoarseTracing {
 public:
  CoarseTracing(Tracing& tracing, double after_ms)
      : tracing_(tracing),
        after_ms_(after_ms),
        columns_(blocks_along(tracing.scene.camera.width)),
        picture_{Image(tracing.scene.camera.width, tracing.scene.camera.height,
                       channel_count(tracing.scene)),
                 {},
                 {}} {
    const std::size_t blocks = columns_ * blocks_along(tracing.scene.camera.height);
    picture_.coarseness.assign(blocks, static_cast<std::uint8_t>(first_step_));
    picture_.subtile_ms.assign(blocks, 0);
  }

  std::optional<CoarsePicture> trace() && {
    for (int step = first_step_; step >= 1; step /= 2) {
      const bool is_done = trace_level(step);
      if (tracing_.progress.stop) return {};
      // Only what is complete may stand for others: where it was begun, blocks have themselves.
      if (!is_done) break;
      for (std::uint8_t& coarseness : picture_.coarseness)
        coarseness = std::min(coarseness, static_cast<std::uint8_t>(step));
    }
    ++tracing_.passes_done;
    show();
    return std::move(picture_);
  }

 private:
  /// False if not all of it was done.
  bool trace_level(int step) {
    const std::vector<Tile> rows = rows_of_blocks(picture_.image, step, step == first_step_);
    std::vector<BeyondRange> beyond(rows.size());
    std::atomic<bool> stop{false};
    tracing_.pool.run(
        rows.size(),
        [&](std::size_t i) {
          const Tile& row = rows[i];
          const int count = (row.width() + row.block_step - 1) / row.block_step;
          const double expected_ms = count * traced_ms_ / std::max(traced_blocks_.load(), 1);
          if (tracing_.progress.stop ||
              (step < first_step_ && tracing_.is_over_time(expected_ms + after_ms_)))
            stop = true;
          if (stop) return;
          // By the other clock a thread that had to wait would be thought slow.
          const ThreadStopwatch watch;
          beyond[i] = trace_once(tracing_, row, picture_.image);
          note(row, count, watch.elapsed_ms());
          tracing_.report(0);
        },
        stop);
    for (const BeyondRange& in_row : beyond) tracing_.beyond += in_row;
    return !stop;
  }

  void note(const Tile& row, int count, double elapsed_ms) {
    traced_ms_ += elapsed_ms;
    traced_blocks_ += count;
    for (int x = row.x_begin; x < row.x_end; x += row.block_step) {
      const std::size_t block = index_of(x, row.y_begin);
      picture_.coarseness[block] = 1;
      picture_.subtile_ms[block] = static_cast<float>(elapsed_ms / count);
    }
  }

  std::size_t index_of(int x, int y) const { return block_index(x, y, columns_); }

  /// Has subtiles show what they stand for.
  void show() {
    Image& image = picture_.image;
    tracing_.pool.run(picture_.coarseness.size() / columns_, [&](std::size_t row) {
      const int y = static_cast<int>(row) * block_side;
      for (int x = 0; x < image.width; x += block_side) show_block(x, y);
    });
  }

  void show_block(int x, int y) {
    Image& image = picture_.image;
    const int coarseness = picture_.coarseness[index_of(x, y)];
    const int from_x = origin_of(x, coarseness);
    const int from_y = origin_of(y, coarseness);
    const Tile subtile = corner_of(image, from_x, from_y, subtile_side);
    const Values mean = subtile_mean(image, from_x, from_y);
    for_each_pixel(corner_of(image, x, y, block_side), 1, [&](int to_x, int to_y) {
      if (from_x == x && from_y == y && to_x < subtile.x_end && to_y < subtile.y_end) return;
      std::transform(mean.begin(), mean.begin() + image.channels, image.pixel(to_x, to_y),
                     [](double value) { return static_cast<float>(value); });
    });
  }

  Tracing& tracing_;
  double after_ms_;
  std::size_t columns_;
  CoarsePicture picture_;
  int first_step_ = first_step(picture_.image);
  std::atomic<double> traced_ms_{0};  ///< of all threads
  std::atomic<int> traced_blocks_{0};
};

}  // namespace

double coarsest_share(int width, int height) {
  const std::size_t blocks = blocks_along(width) * blocks_along(height);
  if (are_few_blocks(blocks)) return 1;
  const double pixels = static_cast<double>(width) * height;
  return std::min(static_cast<double>(std::min(blocks, least_coarse_blocks)) * subtile_side *
                      subtile_side / pixels,
                  1.0);
}

bool CoarsePicture::is_at_most(int most) const {
  return std::all_of(coarseness.begin(), coarseness.end(),
                     [most](std::uint8_t value) { return value <= most; });
}

std::optional<CoarsePicture> trace_coarse_picture(Tracing& tracing, double after_ms) {
  return CoarseTracing(tracing, after_ms).trace();
}

BeyondRange trace_once(const Tracing& tracing, const Tile& tile, Image& image) {
  return render_tile(tracing.tracer, sample_pattern(1), tile,
                     {tracing.scene.render.transfer, &image});
}

std::array<double, subtiles_in_block> guess_errors2(const Image& image, const Tile& block,
                                                    int coarseness) {
  std::array<double, subtiles_in_block> errors2{};
  const double coarse =
      coarseness == 0 ? 0 : coarse_error2(image, block.x_begin, block.y_begin, coarseness);
  for_each_pixel(block, subtile_side, [&](int x, int y) {
    const Tile subtile = corner_of(image, x, y, subtile_side);
    errors2[static_cast<std::size_t>(block.subtile_of(x, y))] =
        coarseness == 0 ? neighbour_error2(image, subtile) : coarse * count_pixels(subtile);
  });
  return errors2;
}

}  // namespace raytracer

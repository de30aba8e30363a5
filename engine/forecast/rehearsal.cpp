#include "engine/forecast/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "engine/errors/error_model.h"
#include "engine/math/r2_sequence.h"
#include "engine/measure/stopwatch.h"
#include "engine/plan/light_sampling.h"
#include "engine/plan/sampling.h"
#include "engine/plan/tiles.h"
#include "engine/sample/pattern.h"

namespace raytracer {
namespace {

using Model = ForecastModel;

constexpr int few_samples = RefinementModel::first_step;
constexpr int many_samples = RefinementModel::second_step;

/// A tile to be timed, and the one before it in the image's order, which is traced first: a thread
/// of a render comes from there, and the caches hold some of what both need.
struct TimedTile {
  Tile tile;
  std::optional<Tile> before;  ///< none if it is timed, too: two threads must not write one tile
};

/// `count` of the tiles, of which every first part is spread over the image, along R2.
std::vector<TimedTile> spread_tiles(const std::vector<Tile>& tiles, std::size_t columns,
                                    std::size_t count) {
  const std::size_t rows = tiles.size() / columns;
  std::vector<std::size_t> chosen;
  std::vector<bool> is_chosen(tiles.size(), false);
  for (std::size_t i = 1; chosen.size() < count; ++i) {
    const auto along = [&](double step, std::size_t cells) {
      const double place = static_cast<double>(i) * step;
      return static_cast<std::size_t>((place - std::floor(place)) * static_cast<double>(cells));
    };
    std::size_t index = along(1 / (plastic_number * plastic_number), rows) * columns +
                        along(1 / plastic_number, columns);
    while (is_chosen[index]) index = (index + 1) % tiles.size();
    is_chosen[index] = true;
    chosen.push_back(index);
  }
  std::vector<TimedTile> timed;
  for (const std::size_t index : chosen) {
    timed.push_back({tiles[index], {}});
    if (index > 0 && !is_chosen[index - 1]) timed.back().before = tiles[index - 1];
  }
  return timed;
}

using TileValues = std::vector<float>;

TileValues values_of(const Tile& tile, Image& image) {
  TileValues values;
  for (int y = tile.y_begin; y < tile.y_end; ++y)
    values.insert(values.end(), image.pixel(tile.x_begin, y),
                  image.pixel(tile.x_begin, y) + image.length_of(tile.width()));
  return values;
}

/// Where the squared error c n^-3/2 of pixels with n samples sums up to a bound with the fewest
/// samples, n grows as c^(2/5) (engine/sample/refinement.h).
constexpr double fall = SampleErrorModel::edge_fall;

double squared_difference(std::span<const float> a, std::span<const float> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return sum;
}

/// The sum of c^(2/5) over the pixels of a tile, of so many values each.
double refinement_sum(const TileValues& one, const TileValues& many, std::size_t channels) {
  double sum = 0;
  for (std::size_t i = 0; i < one.size(); i += channels)
    sum += std::pow(squared_difference(std::span(one).subspan(i, channels),
                                       std::span(many).subspan(i, channels)),
                    1 / (1 + fall));
  return sum;
}

/// An image's memory is made when it is first written, in pieces larger than the tile whose turn it
/// is: that belongs to the image and not to this tile.
void touch(const Tile& tile, const Canvas& canvas) {
  std::visit(
      [&](auto* image) {
        for (int y = tile.y_begin; y < tile.y_end; ++y)
          std::fill_n(image->pixel(tile.x_begin, y), image->length_of(tile.width()), 0);
      },
      canvas);
}

/// What it takes to ask a thread for its time twice: as long as a tile of background.
double asking_ms() {
  double least = infinity;
  for (int i = 0; i < Model::tries; ++i) {
    const ThreadStopwatch watch;
    least = std::min(least, watch.elapsed_ms());
  }
  return least;
}

/// What one tile has told.
struct TileReport {
  double one_ms = -1;     ///< negative: not traced
  double many_ms = -1;    ///< negative: not compared
  double one_error2 = 0;  ///< sums of squares over values, against many samples
  double few_error2 = 0;
  std::size_t value_count = 0;
  double refinement = 0;  ///< refinement_sum() of one sample
};

/// The rms error of `samples` per pixel, from its difference to many samples, which have an error
/// of their own: both fall about as n^(-3/4) where edges cross pixels.
double error_from_difference(double sum_of_squares, double count, double samples) {
  const double own_share = error_power(samples) / error_power(many_samples);
  return std::sqrt(sum_of_squares / count / (1 + own_share));
}

/// What each sample takes where a pixel is refined, from what one and many everywhere take.
double refined_sample_ms(double one_ms, double many_ms) {
  return std::max(many_ms - one_ms, 0.0) / (many_samples - 1);
}

Rehearsal summarize(const std::vector<TileReport>& reports, std::size_t tile_count, int channels) {
  Rehearsal rehearsal{.tile_count = tile_count};
  double one_ms = 0;
  double compared_one_ms = 0;
  double many_ms = 0;
  double one_error2 = 0;
  double few_error2 = 0;
  double value_count = 0;
  double refinement = 0;
  double refining_ms = 0;
  for (const TileReport& report : reports) {
    if (report.one_ms < 0) continue;
    ++rehearsal.timed;
    one_ms += report.one_ms;
    if (report.many_ms < 0) continue;
    ++rehearsal.compared;
    compared_one_ms += report.one_ms;
    many_ms += report.many_ms;
    one_error2 += report.one_error2;
    few_error2 += report.few_error2;
    value_count += static_cast<double>(report.value_count);
    refinement += report.refinement;
    refining_ms += report.refinement * refined_sample_ms(report.one_ms, report.many_ms);
  }
  if (rehearsal.compared == 0) return rehearsal;
  rehearsal.tile_ms = one_ms / static_cast<double>(rehearsal.timed);
  // As many times longer as in the tiles that were traced with both.
  const double growth = compared_one_ms > 0 ? std::max(many_ms / compared_one_ms, 1.0) : 1;
  rehearsal.sample_ms = rehearsal.tile_ms * (growth - 1) / (many_samples - 1);

  if (refinement > 0) {
    const double pixel_count = value_count / channels;
    rehearsal.refined_share =
        std::pow(refinement, (1 + fall) / fall) / (pixel_count * std::pow(one_error2, 1 / fall));
    rehearsal.refined_sample_ms = refining_ms / refinement;
  }

  rehearsal.error = error_from_difference(one_error2, value_count, 1);
  const double few_error = error_from_difference(few_error2, value_count, few_samples);
  constexpr double slowest = SampleErrorModel::random_fall / 2;
  constexpr double fastest = SampleErrorModel::smooth_fall / 2;
  const double measured = few_error > 0 ? std::log(rehearsal.error / few_error) /
                                              std::log(static_cast<double>(few_samples))
                                        : fastest;
  rehearsal.error_exponent = std::clamp(measured, slowest, fastest);
  return rehearsal;
}

/// Notes what samples change.
void compare(const TileValues& with_one, const TileValues& with_few, const TileValues& with_many,
             std::size_t channels, TileReport& report) {
  report.one_error2 = squared_difference(with_one, with_many);
  report.few_error2 = squared_difference(with_few, with_many);
  report.value_count = with_many.size();
  report.refinement = refinement_sum(with_one, with_many, channels);
}

/// Where points look for what hides soft lights all together: all tiles at once.
Rehearsal rehearse_swept(const Scene& scene, const Tracer& tracer, const std::vector<Tile>& tiles,
                         std::size_t tile_count, WorkerPool& pool, const RenderProgress& progress) {
  Image image(scene.camera.width, scene.camera.height, channel_count(scene));
  avoid_huge_pages(image.values);
  const auto trace = [&](int samples, std::vector<TileValues>& values) {
    SweptTiles swept = trace_swept(tracer, sample_pattern(samples), tiles,
                                   {scene.render.transfer, &image}, pool, progress.stop);
    for (std::size_t i = 0; i < tiles.size(); ++i) values[i] = values_of(tiles[i], image);
    return swept;
  };
  std::vector<TileValues> with_one(tiles.size());
  std::vector<TileValues> with_few(tiles.size());
  std::vector<TileValues> with_many(tiles.size());
  for (const Tile& tile : tiles) touch(tile, &image);
  const SweepCost cost = measure_sweeps(tracer, tiles);
  const SweptTiles one = trace(1, with_one);
  trace(few_samples, with_few);
  const SweptTiles many = trace(many_samples, with_many);
  if (progress.stop) return {};
  std::vector<TileReport> reports(tiles.size());
  // What the points took of the sweeps, shared evenly.
  const auto of_points = [&](const SweptTiles& swept, int samples) {
    SweepCost once = cost;
    once.pixels = 1;
    once.pixels_at_once = samples;
    return std::max(swept.sweeps_ms - once.ms(samples), 0.0) / static_cast<double>(tiles.size());
  };
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    reports[i].one_ms = one.tile_ms[i] + of_points(one, 1);
    reports[i].many_ms = many.tile_ms[i] + of_points(many, many_samples);
    compare(with_one[i], with_few[i], with_many[i], image.length_of(1), reports[i]);
  }
  Rehearsal rehearsal = summarize(reports, tile_count, image.channels);
  rehearsal.sweeps = cost;
  return rehearsal;
}

}  // namespace

double Rehearsal::error_of(double samples) const {
  return error * std::pow(samples, -error_exponent);
}

Rehearsal rehearse(const Scene& scene, const Tracer& tracer, WorkerPool& pool,
                   const RenderProgress& progress, double pass_limit_ms) {
  const int side = std::min(Model::tile_side_px,
                            interruptible_side_px(many_samples, light_rays_per_sample(scene)));
  const std::vector<Tile> all = split_into_tiles(scene.camera.width, scene.camera.height, side);
  const auto columns = static_cast<std::size_t>((scene.camera.width + side - 1) / side);
  const std::vector<TimedTile> tiles =
      spread_tiles(all, columns, std::min(all.size(), Model::most_tiles));
  if (is_swept(tracer)) {
    std::vector<Tile> swept(tiles.size());
    std::transform(tiles.begin(), tiles.end(), swept.begin(),
                   [](const TimedTile& timed) { return timed.tile; });
    return rehearse_swept(scene, tracer, swept, all.size(), pool, progress);
  }
  const SamplePattern one = sample_pattern(1);
  const SamplePattern few = sample_pattern(few_samples);
  const SamplePattern many = sample_pattern(many_samples);
  Image image(scene.camera.width, scene.camera.height, channel_count(scene));
  avoid_huge_pages(image.values);  // a few tiles are written: each would clear some megabytes
  const bool makes_bytes = !needs_floats(scene);
  ByteImage bytes;  // what most renders of fixed samples make
  Canvas timed = &image;
  if (makes_bytes) {
    bytes = ByteImage(scene.camera.width, scene.camera.height);
    avoid_huge_pages(bytes.values);
    timed = &bytes;
  }
  std::vector<TileReport> reports(tiles.size());
  const double asked_ms = asking_ms();
  const auto trace = [&](const SamplePattern& pattern, const Tile& tile, const Canvas& canvas) {
    render_tile(tracer, pattern, tile, {scene.render.transfer, canvas});
  };
  const auto trace_ms = [&](const SamplePattern& pattern, const Tile& tile, const Canvas& canvas) {
    const ThreadStopwatch watch;
    trace(pattern, tile, canvas);
    return std::max(watch.elapsed_ms() - asked_ms, 0.0);
  };

  const Stopwatch timing;
  pool.run(
      tiles.size(),
      [&](std::size_t i) {
        if (i > 0 && timing.elapsed_ms() > pass_limit_ms) return;
        const auto& [tile, before] = tiles[i];
        if (before) trace(one, *before, timed);
        touch(tile, timed);
        reports[i].one_ms = trace_ms(one, tile, timed);
      },
      progress.stop);
  const Stopwatch comparing;
  pool.run(
      tiles.size(),
      [&](std::size_t i) {
        TileReport& report = reports[i];
        const bool is_late = i > 0 && comparing.elapsed_ms() > pass_limit_ms;
        if (report.one_ms < 0 || is_late || progress.stop) return;
        const Tile& tile = tiles[i].tile;
        if (makes_bytes) trace(one, tile, &image);
        const TileValues with_one = values_of(tile, image);
        trace(few, tile, &image);
        const TileValues with_few = values_of(tile, image);
        report.many_ms = trace_ms(many, tile, &image);
        const TileValues with_many = values_of(tile, image);
        compare(with_one, with_few, with_many, image.length_of(1), report);
      },
      progress.stop);
  return summarize(reports, all.size(), image.channels);
}

}  // namespace raytracer

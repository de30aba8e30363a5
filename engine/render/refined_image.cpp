#include "engine/render/refined_image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "engine/errors/error_model.h"
#include "engine/image/pixel_spreads.h"
#include "engine/math/block.h"
#include "engine/measure/stopwatch.h"
#include "engine/sample/pattern.h"
#include "engine/sample/subpixel_objects.h"

namespace raytracer {
namespace {

/// Replaces an image's pixel, and says by how much: the squared difference, its channels' sum; 0 if
/// that is no number.
double replace(std::span<float> pixel, const float* values) {
  double change2 = 0;
  for (float& channel : pixel) {
    const double difference = static_cast<double>(*values) - static_cast<double>(channel);
    change2 += difference * difference;
    channel = *values++;
  }
  return std::isfinite(change2) ? change2 : 0;
}

bool is_all_done(const std::vector<char>& is_done) {
  return std::find(is_done.begin(), is_done.end(), 0) == is_done.end();
}

}  // namespace

RefinedImage::RefinedImage(Tracing& tracing, Image& image)
    : tracing_(tracing),
      width_(tracing.scene.camera.width),
      height_(tracing.scene.camera.height),
      errors_(width_, height_, choose_error_multiplier(tracing.plan.statistics),
              {image, tracing.scene.render.transfer}, tracing.pool),
      shown_(tracing.progress.preview, image),
      image_(image) {}

bool RefinedImage::begin(const SamplePattern& pattern) {
  std::optional<Image> image =
      tracing_.pass<float>(pattern, {.pixels = &errors_.spreads()}, whole_image(width_, height_));
  if (!image) return false;
  const auto samples = static_cast<int>(pattern.points.size());
  note_first_pass(samples);
  shown_.change([&](Image& whole) { whole = std::move(*image); });
  errors_.set_all(samples);
  if (pattern.has_half_buffers())
    estimate_errors();
  else
    guess_errors(std::vector<std::uint8_t>(errors_.block_count(), 0));
  return true;
}

void RefinedImage::begin(CoarsePicture first) {
  note_first_pass(1);
  shown_.change([&](Image& whole) { whole = std::move(first.image); });
  errors_.set_all(1);
  guess_errors(first.coarseness);
  for (std::size_t block = 0; block < first.coarseness.size(); ++block) {
    if (first.coarseness[block] == 0) continue;
    const Tile tile = errors_.tile_of(block);
    const int traced = std::min(tile.width(), subtile_side) * std::min(tile.height(), subtile_side);
    stand_ins_ += tile.width() * tile.height() - (first.coarseness[block] == 1 ? traced : 0);
  }
}

void RefinedImage::guess_errors(const std::vector<std::uint8_t>& coarseness) {
  const Stopwatch watch;
  const std::size_t columns = blocks_along(width_);
  tracing_.pool.run(coarseness.size() / columns, [&](std::size_t row) {
    for (std::size_t block = columns * row; block < columns * (row + 1); ++block) {
      const auto errors2 = guess_errors2(image_, errors_.tile_of(block), coarseness[block]);
      for (std::size_t i = 0; i < subtiles_in_block; ++i)
        errors_.set_guess(subtiles_in_block * block + i, errors2[i]);
    }
  });
  errors_.use_guesses();
  const double guess_ms = watch.elapsed_ms();
  // Estimates take each pixel through the transfer besides, which guesses do not: as long as for a
  // row of them, row by row.
  const ShownError shown(image_, tracing_.scene.render.transfer);
  shown(1e-4, 0, height_ / 2);  // the first makes its tables
  const Stopwatch row_watch;
  for (int x = 0; x < width_; ++x) shown(1e-4, x, height_ / 2);
  const double rows_per_thread = height_ / static_cast<double>(tracing_.pool.thread_count());
  transfer_ms_ = row_watch.elapsed_ms() * rows_per_thread;
  after_ms_ = RefinementModel::half_buffer_cost * guess_ms + transfer_ms_;
}

void RefinedImage::look_for_subpixel_objects(int samples) {
  if (!(tracing_.plan.statistics.all.subpixel > 0)) return;
  // A plan packs the scene and looks at all objects, too.
  if (tracing_.is_over_time(tracing_.plan_ms)) return;
  errors_.set_subpixel(SubpixelObjects(pack_scene(tracing_.scene, &tracing_.pool), image_.channels),
                       samples);
}

double RefinedImage::mean_samples() const {
  return static_cast<double>(errors_.sample_count() - stand_ins_) /
         (static_cast<double>(width_) * height_);
}

std::vector<PixelSamples> RefinedImage::choose_samples(double goal_error2, int most_samples) const {
  const double sum = errors_.expected_error2();
  const double goal = goal_error2 * sum / error2();
  // What smooth pixels err would not be missed; most are smooth.
  const double negligible = RefinementModel::negligible * (goal > 0 ? goal : sum) /
                            (static_cast<double>(width_) * height_);
  std::vector<PixelError> pixels;
  double smooth = 0;
  errors_.for_each_error([&](std::size_t pixel, double error2) {
    if (error2 > negligible)
      pixels.push_back(
          {static_cast<std::uint32_t>(pixel), errors_.samples(pixel), static_cast<float>(error2)});
    else
      smooth += error2;
  });
  return raytracer::choose_samples(
      pixels, {.error2 = std::max(goal - smooth, 0.0),
               .samples = std::max(tracing_.rest_ms() - after_ms_, 0.0) / sample_ms_,
               .most_samples = most_samples});
}

bool RefinedImage::refine(std::vector<PixelSamples> pixels) {
  const std::vector<RefinementTask> tasks = pixel_tasks(pixels, errors_);
  std::vector<std::uint8_t> places(pixels.size());
  std::transform(pixels.begin(), pixels.end(), places.begin(), [&](const PixelSamples& pixel) {
    return static_cast<std::uint8_t>(errors_.x_of(pixel.pixel) % block_side +
                                     errors_.y_of(pixel.pixel) % block_side * block_side);
  });
  for (const RefinementTask& task : tasks)
    if (!patterns_.contains(task.samples_per_pixel))
      patterns_[task.samples_per_pixel] = jittered_pattern(task.samples_per_pixel);
  // Their errors are taken through the transfer before the multiplier is known, too.
  after_ms_ +=
      transfer_ms_ * static_cast<double>(pixels.size()) / (static_cast<double>(width_) * height_);
  std::vector<SampledPixel> sampled(pixels.size());
  const std::vector<char> is_done = run_tasks(tasks, [&](const RefinementTask& task) {
    std::vector<BlockPixels> blocks;
    for (std::size_t begin = task.begin; begin < task.end;) {
      const std::size_t block = errors_.block_of(pixels[begin].pixel);
      std::size_t end = begin + 1;
      while (end < task.end && errors_.block_of(pixels[end].pixel) == block) ++end;
      const Tile tile = errors_.tile_of(block);
      blocks.push_back({tile.x_begin, tile.y_begin, std::span(places).subspan(begin, end - begin),
                        image_.channels});
      begin = end;
    }
    sample_pixels(tracing_.tracer, patterns_.at(task.samples_per_pixel),
                  tracing_.scene.render.transfer, blocks,
                  std::span(sampled).subspan(task.begin, task.end - task.begin));
  });

  const auto for_each_done = [&](const auto& visit) {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      if (is_done[i] != 0)
        for (std::size_t k = tasks[i].begin; k < tasks[i].end; ++k)
          visit(pixels[k].pixel, pixels[k].samples, sampled[k]);
  };
  double change2 = 0;
  shown_.change([&](Image& image) {
    for_each_done([&](std::uint32_t pixel, int, const SampledPixel& by) {
      float* const values = image.pixel(errors_.x_of(pixel), errors_.y_of(pixel));
      change2 += replace({values, image.length_of(1)}, by.values.data());
    });
  });
  for_each_done([&](std::uint32_t pixel, int samples, const SampledPixel& by) {
    errors_.refine(pixel, samples, by.spread);
    tracing_.beyond.not_numbers += by.is_number ? 0 : 1;
  });
  errors_.learn(change2);
  after_ms_ = tracing_.watch.elapsed_ms() - last_sample_ms_;
  return is_all_done(is_done);
}

bool RefinedImage::refine_all(const SamplePattern& pattern) {
  const auto samples = static_cast<int>(pattern.points.size());
  const std::vector<RefinementTask> tasks = block_tasks(errors_, samples);
  Image finer(width_, height_, image_.channels);
  PixelSpreads spreads(width_, height_);
  std::atomic<std::size_t> not_numbers{0};
  const std::vector<char> is_done = run_tasks(tasks, [&](const RefinementTask& task) {
    const auto block = static_cast<std::size_t>(&task - tasks.data());
    not_numbers += render_tile(tracing_.tracer, pattern, errors_.tile_of(block),
                               {tracing_.scene.render.transfer, &finer, {.pixels = &spreads}})
                       .not_numbers;
  });
  shown_.change([&](Image& image) {
    for (std::size_t block = 0; block < tasks.size(); ++block) {
      if (is_done[block] == 0) continue;
      const Tile tile = errors_.tile_of(block);
      copy_tile(finer, tile, image);
      errors_.forget_guesses(block);
      for (int y = tile.y_begin; y < tile.y_end; ++y)
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
          const std::size_t pixel = errors_.index(x, y);
          errors_.set(pixel, samples, {spreads.error2[pixel], spreads.variance[pixel]});
        }
    }
  });
  tracing_.beyond.not_numbers += not_numbers;
  estimate_errors();
  return is_all_done(is_done);
}

template <typename Run>
std::vector<char> RefinedImage::run_tasks(const std::vector<RefinementTask>& tasks,
                                          const Run& run) {
  std::vector<char> is_done(tasks.size(), 0);
  // What there is no time for should be what would have helped least.
  std::vector<std::size_t> order;
  if (tracing_.scene.render.budget_ms) order = most_useful_first(tasks);
  const double begin_ms = tracing_.watch.elapsed_ms();
  std::atomic<bool> stop{tracing_.progress.stop || tracing_.is_over_time()};
  std::atomic<std::size_t> done{0};
  const double thread_sample_ms = sample_ms_ * static_cast<double>(tracing_.pool.thread_count());
  tracing_.pool.run(
      tasks.size(),
      [&](std::size_t i) {
        const std::size_t which = order.empty() ? i : order[i];
        const RefinementTask& task = tasks[which];
        if (tracing_.progress.stop ||
            tracing_.is_over_time(after_ms_ + thread_sample_ms * task.samples)) {
          stop = true;
          return;
        }
        run(task);
        is_done[which] = 1;
        tracing_.report(static_cast<double>(++done) / static_cast<double>(tasks.size()));
      },
      stop);
  last_sample_ms_ = tracing_.watch.elapsed_ms();
  double samples = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (is_done[i] != 0) samples += tasks[i].samples;
  if (samples > 0) sample_ms_ = (last_sample_ms_ - begin_ms) / samples;
  ++tracing_.passes_done;
  return is_done;
}

void RefinedImage::estimate_errors() {
  errors_.estimate();
  after_ms_ = tracing_.watch.elapsed_ms() - last_sample_ms_;
}

void RefinedImage::note_first_pass(int samples) {
  // A single tile keeps one thread busy and the others waiting.
  const bool is_one_thread = is_one_tile(tracing_.scene, samples);
  const std::size_t threads = is_one_thread ? tracing_.pool.thread_count() : 1;
  last_sample_ms_ = tracing_.watch.elapsed_ms();
  sample_ms_ = last_sample_ms_ /
               (static_cast<double>(width_) * height_ * samples * static_cast<double>(threads));
}

}  // namespace raytracer

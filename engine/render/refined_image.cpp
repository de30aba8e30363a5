#include "engine/render/refined_image.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "engine/image/pixel_spreads.h"
#include "engine/math/block.h"
#include "engine/sample/missable_spheres.h"
#include "engine/sample/neighbour_error.h"
#include "engine/scene/scene_size.h"

namespace raytracer {
namespace {

/// Replaces an image's pixel, and says by how much: the squared difference, its channels' sum; 0 if
/// that is no number.
double replace(float* pixel, const std::array<float, 3>& color) {
  double change2 = 0;
  for (const float channel : color) {
    const double difference = static_cast<double>(channel) - static_cast<double>(*pixel);
    change2 += difference * difference;
    *pixel++ = channel;
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
      errors_(width_, height_, error_scale(tracing.plan.census), tracing.pool),
      shown_(tracing.progress.preview, image),
      image_(image) {}

bool RefinedImage::begin(const SamplePattern& pattern) {
  std::optional<Image> image = tracing_.pass<float>(pattern, {.pixels = &errors_.spreads()});
  if (!image) return false;
  const auto samples = static_cast<int>(pattern.points.size());
  note_first_pass(samples);
  shown_.change([&](Image& whole) { whole = std::move(*image); });
  errors_.set_all(samples);
  if (pattern.has_halves())
    expect_errors();
  else
    guess_errors(std::vector<char>(errors_.block_count(), 1));
  return true;
}

void RefinedImage::begin(FirstPicture first) {
  note_first_pass(1);
  shown_.change([&](Image& whole) { whole = std::move(first.image); });
  errors_.set_all(1);
  guess_errors(first.is_traced);
  for (std::size_t block = 0; block < first.is_traced.size(); ++block) {
    if (first.is_traced[block] != 0) continue;
    const Tile tile = errors_.tile_of(block);
    const int width = tile.x_end - tile.x_begin;
    const int height = tile.y_end - tile.y_begin;
    stand_ins_ += width * height - std::min(width, part_side) * std::min(height, part_side);
  }
}

void RefinedImage::guess_errors(const std::vector<char>& is_traced) {
  constexpr std::size_t blocks_at_once = 16;
  const std::atomic<bool> never{false};
  tracing_.pool.run((is_traced.size() + blocks_at_once - 1) / blocks_at_once,
                    [&](std::size_t i) {
                      const std::size_t end = std::min(blocks_at_once * (i + 1), is_traced.size());
                      for (std::size_t block = blocks_at_once * i; block < end; ++block)
                        guess_errors(block, is_traced[block] != 0);
                    },
                    never);
  errors_.expect_guesses();
  // The next look is at each pixel: 1.3e-5 to 1.6e-5 ms of one on one thread of an AMD EPYC.
  constexpr double look_at_pixel_ms = 2e-5;
  after_ms_ =
      look_at_pixel_ms * width_ * height_ / static_cast<double>(tracing_.pool.thread_count());
}

void RefinedImage::guess_errors(std::size_t block, bool is_traced) {
  const Tile tile = errors_.tile_of(block);
  const double coarse =
      is_traced ? 0 : coarse_error2(image_, tile.x_begin / block_side, tile.y_begin / block_side);
  for (std::size_t i = 0; i < parts_in_block; ++i) {
    const int x = tile.x_begin + static_cast<int>(i) % parts_across * part_side;
    const int y = tile.y_begin + static_cast<int>(i) / parts_across * part_side;
    const Tile part{x, y, std::min(x + part_side, tile.x_end), std::min(y + part_side, tile.y_end)};
    const int width = part.x_end - x;
    const int height = part.y_end - y;
    if (width <= 0 || height <= 0) continue;
    errors_.set_guess(parts_in_block * block + i,
                      is_traced ? neighbour_error2(image_, part) : coarse * width * height);
  }
}

void RefinedImage::look_for_missable_spheres() {
  constexpr double sphere_ms = 5e-5;
  if (!(tracing_.plan.census.small_spheres > 0)) return;
  const auto objects = static_cast<double>(count_objects(tracing_.scene));
  if (tracing_.is_over_time(sphere_ms * objects)) return;
  errors_.set_missable(MissableSpheres(tracing_.scene, tracing_.plan.frame));
}

double RefinedImage::mean_samples() const {
  return static_cast<double>(errors_.sample_count() - stand_ins_) /
         (static_cast<double>(width_) * height_);
}

std::vector<PixelSamples> RefinedImage::next_samples(double goal_error2, int most_samples) const {
  const double sum = errors_.expected_error2();
  const double goal = goal_error2 * sum / error2();
  // What smooth pixels err would not be missed; most are smooth.
  const double share = goal > 0 ? 0.01 * goal : 0.02 * sum;
  const double negligible = share / (static_cast<double>(width_) * height_);
  std::vector<RoughPixel> rough;
  double smooth = 0;
  errors_.for_each_rough([&](std::size_t pixel, double error2) {
    if (error2 > negligible)
      rough.push_back(
          {static_cast<std::uint32_t>(pixel), errors_.samples(pixel), static_cast<float>(error2)});
    else
      smooth += error2;
  });
  return raytracer::next_samples(
      rough, {.error2 = std::max(goal - smooth, 0.0),
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
      patterns_[task.samples_per_pixel] = sample_pattern(task.samples_per_pixel);
  std::vector<SampledPixel> sampled(pixels.size());
  const std::vector<char> is_done = run_tasks(tasks, [&](const RefinementTask& task) {
    const Tile tile = errors_.tile_of(task.block);
    const std::size_t count = task.end - task.begin;
    sample_pixels(tracing_.tracer, patterns_.at(task.samples_per_pixel),
                  tracing_.scene.render.transfer,
                  {tile.x_begin, tile.y_begin, std::span(places).subspan(task.begin, count)},
                  std::span(sampled).subspan(task.begin, count));
  });

  const auto for_each_done = [&](const auto& visit) {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      if (is_done[i] != 0)
        for (std::size_t k = tasks[i].begin; k < tasks[i].end; ++k)
          visit(pixels[k].pixel, pixels[k].samples, sampled[k]);
  };
  std::vector<std::uint32_t> changed;
  changed.reserve(pixels.size());
  for_each_done([&](std::uint32_t pixel, int, const SampledPixel&) { changed.push_back(pixel); });
  const std::vector<float> before = errors_.unscaled(changed);
  double change2 = 0;
  shown_.change([&](Image& image) {
    for_each_done([&](std::uint32_t pixel, int, const SampledPixel& by) {
      change2 += replace(image.pixel(errors_.x_of(pixel), errors_.y_of(pixel)), by.color);
    });
  });
  for_each_done([&](std::uint32_t pixel, int samples, const SampledPixel& by) {
    errors_.set(pixel, samples, by.spread);
    tracing_.beyond.not_numbers += by.is_number ? 0 : 1;
  });
  errors_.expect();
  errors_.calibrate(changed, before, change2);
  after_ms_ = tracing_.watch.elapsed_ms() - last_sample_ms_;
  return is_all_done(is_done);
}

bool RefinedImage::refine_all(const SamplePattern& pattern) {
  const auto samples = static_cast<int>(pattern.points.size());
  const std::vector<RefinementTask> tasks = block_tasks(errors_, samples);
  Image finer(width_, height_);
  PixelSpreads spreads(width_, height_);
  std::atomic<std::size_t> not_numbers{0};
  const std::vector<char> is_done = run_tasks(tasks, [&](const RefinementTask& task) {
    not_numbers += render_tile(tracing_.tracer, pattern, tracing_.scene.render.transfer,
                               errors_.tile_of(task.block), &finer, {.pixels = &spreads})
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
  expect_errors();
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

void RefinedImage::expect_errors() {
  errors_.expect();
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

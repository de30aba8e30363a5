#include "engine/render/refined_image.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/image/pixel_spreads.h"
#include "engine/math/block.h"
#include "engine/sample/missable_spheres.h"
#include "engine/sample/neighbour_error.h"
#include "engine/scene/scene_size.h"

namespace raytracer {
namespace {

/// Replaces an image's pixel, and says by how much: the squared difference, its channels' sum.
double replace(float* pixel, const std::array<float, 3>& color) {
  double change2 = 0;
  for (const float channel : color) {
    const double difference = static_cast<double>(channel) - static_cast<double>(*pixel);
    change2 += difference * difference;
    *pixel++ = channel;
  }
  return change2;
}

}  // namespace

RefinedImage::RefinedImage(Tracing& tracing, Image& image)
    : tracing_(tracing),
      width_(tracing.scene.camera.width),
      height_(tracing.scene.camera.height),
      columns_((width_ + block_side - 1) / block_side),
      errors_(width_, height_, first_scale(tracing.plan.census), tracing.pool),
      shown_(tracing.progress.preview, image),
      image_(image) {}

bool RefinedImage::begin(const SamplePattern& pattern) {
  std::optional<Image> image = tracing_.pass<float>(pattern, {.pixels = &errors_.spreads()});
  if (!image) return false;
  const auto samples = static_cast<int>(pattern.points.size());
  note_first_pass(samples);
  shown_.change([&](Image& whole) { whole = std::move(*image); });
  if (pattern.has_halves())
    errors_.set_all(samples);
  else
    guess_errors(std::vector<char>(block_count(), 1));
  expect_errors();
  return true;
}

void RefinedImage::begin(FirstPicture first) {
  note_first_pass(1);
  shown_.change([&](Image& whole) { whole = std::move(first.image); });
  guess_errors(first.is_traced);
  for (std::size_t block = 0; block < first.is_traced.size(); ++block) {
    if (first.is_traced[block] != 0) continue;
    const Tile tile = tile_of(block);
    const int width = tile.x_end - tile.x_begin;
    const int height = tile.y_end - tile.y_begin;
    stand_ins_ += width * height - std::min(width, part_side) * std::min(height, part_side);
  }
  expect_errors();
}

void RefinedImage::guess_errors(const std::vector<char>& is_traced) {
  const auto columns = static_cast<std::size_t>(columns_);
  const std::atomic<bool> never{false};
  tracing_.pool.run(
      is_traced.size() / columns,
      [&](std::size_t row) {
        for (std::size_t block = row * columns; block < (row + 1) * columns; ++block)
          guess_errors(block, is_traced[block] != 0);
      },
      never);
}

void RefinedImage::guess_errors(std::size_t block, bool is_traced) {
  const Tile tile = tile_of(block);
  const double coarse =
      is_traced ? 0 : coarse_error2(image_, tile.x_begin / block_side, tile.y_begin / block_side);
  for (int y = tile.y_begin; y < tile.y_end; y += part_side)
    for (int x = tile.x_begin; x < tile.x_end; x += part_side) {
      const Tile part{x, y, std::min(x + part_side, tile.x_end),
                      std::min(y + part_side, tile.y_end)};
      const int count = (part.x_end - x) * (part.y_end - y);
      const double error2 = is_traced ? neighbour_error2(image_, part) / count : coarse;
      for (int to_y = y; to_y < part.y_end; ++to_y)
        for (int to_x = x; to_x < part.x_end; ++to_x)
          errors_.set_guess(errors_.index(to_x, to_y), error2);
    }
}

void RefinedImage::look_for_missable_spheres() {
  constexpr double sphere_ms = 5e-5;
  if (!(tracing_.plan.census.small_spheres > 0)) return;
  const auto objects = static_cast<double>(count_objects(tracing_.scene));
  if (tracing_.is_over_time(sphere_ms * objects)) return;
  errors_.set_missable(MissableSpheres(tracing_.scene, tracing_.plan.frame));
  expect_errors();
}

double RefinedImage::mean_samples() const {
  return static_cast<double>(errors_.sample_count() - stand_ins_) /
         (static_cast<double>(width_) * height_);
}

std::vector<PixelSamples> RefinedImage::next_samples(double error2, int most_samples) const {
  const double sum = errors_.expected_error2();
  const double goal = error2 * sum / this->error2();
  // What smooth pixels err would not be missed; most are smooth.
  const double negligible =
      std::max(0.01 * goal, 0.001 * sum) / (static_cast<double>(width_) * height_);
  std::size_t count = 0;
  double smooth = 0;
  errors_.for_each_rough([&](std::size_t, double pixel_error2) {
    if (pixel_error2 > negligible)
      ++count;
    else
      smooth += pixel_error2;
  });
  std::vector<RoughPixel> rough;
  rough.reserve(count);
  errors_.for_each_rough([&](std::size_t pixel, double pixel_error2) {
    if (pixel_error2 > negligible)
      rough.push_back({static_cast<std::uint32_t>(pixel), errors_.samples(pixel),
                       static_cast<float>(pixel_error2)});
  });
  return raytracer::next_samples(
      rough, {.error2 = std::max(goal - smooth, 0.0),
              .samples = std::max(tracing_.rest_ms() - after_ms_, 0.0) / sample_ms_,
              .most_samples = most_samples});
}

bool RefinedImage::refine(std::vector<PixelSamples> pixels) {
  sort_into_tasks(pixels);
  std::vector<std::uint8_t> places(pixels.size());
  std::transform(pixels.begin(), pixels.end(), places.begin(), [&](const PixelSamples& pixel) {
    return static_cast<std::uint8_t>(errors_.x_of(pixel.pixel) % block_side +
                                     errors_.y_of(pixel.pixel) % block_side * block_side);
  });
  const std::vector<Task> tasks = tasks_for(pixels);
  for (const Task& task : tasks)
    if (!patterns_.contains(task.samples_per_pixel))
      patterns_[task.samples_per_pixel] = sample_pattern(task.samples_per_pixel);
  std::vector<SampledPixel> sampled(pixels.size());
  const std::vector<char> is_done = run_tasks(tasks, [&](const Task& task) {
    const Tile tile = tile_of(task.block);
    const std::size_t count = task.end - task.begin;
    sample_pixels(tracing_.tracer, patterns_.at(task.samples_per_pixel),
                  tracing_.scene.render.transfer,
                  {tile.x_begin, tile.y_begin, std::span(places).subspan(task.begin, count)},
                  std::span(sampled).subspan(task.begin, count));
  });

  std::vector<std::uint32_t> changed;
  std::vector<float> before;
  changed.reserve(pixels.size());
  before.reserve(pixels.size());
  double change2 = 0;
  shown_.change([&](Image& image) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (is_done[i] == 0) continue;
      for (std::size_t k = tasks[i].begin; k < tasks[i].end; ++k) {
        const std::uint32_t pixel = pixels[k].pixel;
        changed.push_back(pixel);
        before.push_back(errors_.unscaled(pixel));
        change2 += replace(image.pixel(errors_.x_of(pixel), errors_.y_of(pixel)), sampled[k].color);
        errors_.set(pixel, pixels[k].samples, sampled[k].spread);
        tracing_.beyond.not_numbers += sampled[k].is_number ? 0 : 1;
      }
    }
  });
  errors_.expect();
  errors_.calibrate(changed, before, change2);
  after_ms_ = tracing_.watch.elapsed_ms() - last_sample_ms_;
  return is_all_done(is_done);
}

bool RefinedImage::refine_all(const SamplePattern& pattern) {
  const auto samples = static_cast<int>(pattern.points.size());
  std::vector<Task> tasks(block_count());
  for (std::size_t block = 0; block < tasks.size(); ++block) {
    const Tile tile = tile_of(block);
    const int pixels = (tile.x_end - tile.x_begin) * (tile.y_end - tile.y_begin);
    tasks[block] = {.block = block, .samples = static_cast<double>(samples) * pixels};
  }
  errors_.for_each_rough(
      [&](std::size_t pixel, double error2) { tasks[block_of(pixel)].error2 += error2; });
  Image finer(width_, height_);
  PixelSpreads spreads(width_, height_);
  std::atomic<std::size_t> not_numbers{0};
  const std::vector<char> is_done = run_tasks(tasks, [&](const Task& task) {
    not_numbers += render_tile(tracing_.tracer, pattern, tracing_.scene.render.transfer,
                               tile_of(task.block), &finer, {.pixels = &spreads})
                       .not_numbers;
  });
  shown_.change([&](Image& image) {
    for (std::size_t block = 0; block < tasks.size(); ++block) {
      if (is_done[block] == 0) continue;
      const Tile tile = tile_of(block);
      copy_tile(finer, tile, image);
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
std::vector<char> RefinedImage::run_tasks(const std::vector<Task>& tasks, const Run& run) {
  std::vector<char> is_done(tasks.size(), 0);
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What there is no time for should be what would have helped least.
  if (tracing_.scene.render.budget_ms)
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return tasks[a].error2 * tasks[b].samples > tasks[b].error2 * tasks[a].samples;
    });
  const double begin_ms = tracing_.watch.elapsed_ms();
  std::atomic<bool> stop{tracing_.progress.stop || tracing_.is_over_time()};
  std::atomic<std::size_t> done{0};
  const double thread_sample_ms = sample_ms_ * static_cast<double>(tracing_.pool.thread_count());
  tracing_.pool.run(
      tasks.size(),
      [&](std::size_t i) {
        const Task& task = tasks[order[i]];
        if (tracing_.progress.stop ||
            tracing_.is_over_time(after_ms_ + thread_sample_ms * task.samples)) {
          stop = true;
          return;
        }
        run(task);
        is_done[order[i]] = 1;
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

bool RefinedImage::is_all_done(const std::vector<char>& is_done) const {
  return std::find(is_done.begin(), is_done.end(), 0) == is_done.end();
}

void RefinedImage::sort_into_tasks(std::vector<PixelSamples>& pixels) const {
  for (auto begin = pixels.begin(); begin != pixels.end();) {
    const std::size_t block = block_of(begin->pixel);
    const auto end = std::find_if(begin, pixels.end(), [&](const PixelSamples& pixel) {
      return block_of(pixel.pixel) != block;
    });
    std::stable_sort(begin, end, [](const PixelSamples& a, const PixelSamples& b) {
      return a.samples < b.samples;
    });
    begin = end;
  }
}

std::vector<RefinedImage::Task> RefinedImage::tasks_for(
    std::span<const PixelSamples> pixels) const {
  constexpr double most_samples = 1 << 14;  // others wait for a task, and so does the clock
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t block = block_of(pixels[i].pixel);
    const int samples = pixels[i].samples;
    if (tasks.empty() || tasks.back().block != block || tasks.back().samples_per_pixel != samples ||
        tasks.back().samples >= most_samples)
      tasks.push_back({.block = block, .samples = 0, .begin = i, .samples_per_pixel = samples});
    Task& task = tasks.back();
    task.samples += samples;
    task.error2 += errors_.of_pixel(pixels[i].pixel);
    task.end = i + 1;
  }
  return tasks;
}

Tile RefinedImage::tile_of(std::size_t block) const {
  const int x = static_cast<int>(block) % columns_ * block_side;
  const int y = static_cast<int>(block) / columns_ * block_side;
  return {x, y, std::min(x + block_side, width_), std::min(y + block_side, height_)};
}

std::size_t RefinedImage::block_count() const {
  return static_cast<std::size_t>(columns_) *
         static_cast<std::size_t>((height_ + block_side - 1) / block_side);
}

std::size_t RefinedImage::block_of(std::size_t pixel) const {
  const auto column = static_cast<std::size_t>(errors_.x_of(pixel) / block_side);
  const auto row = static_cast<std::size_t>(errors_.y_of(pixel) / block_side);
  return row * static_cast<std::size_t>(columns_) + column;
}

void RefinedImage::expect_errors() {
  errors_.expect();
  after_ms_ = tracing_.watch.elapsed_ms() - last_sample_ms_;
}

void RefinedImage::note_first_pass(int samples) {
  // A single tile keeps one thread busy and the others waiting.
  const bool is_shared = !is_one_tile(width_, height_, samples, tracing_.scene.lights.size());
  const std::size_t threads = is_shared ? 1 : tracing_.pool.thread_count();
  last_sample_ms_ = tracing_.watch.elapsed_ms();
  sample_ms_ = last_sample_ms_ /
               (static_cast<double>(width_) * height_ * samples * static_cast<double>(threads));
}

}  // namespace raytracer

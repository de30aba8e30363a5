#include "engine/render/refine.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/math/block.h"
#include "engine/render/first_picture.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

/// Parts of one block that get as many samples as each other.
struct Task {
  Tile tile;
  int samples;
  std::array<std::size_t, parts_in_block> parts{};
  std::size_t part_count = 0;

  double sample_count() const {
    return static_cast<double>(part_count) * part_side * part_side * samples;
  }
};

/// The first refinement must find what the later ones follow: an edge along a row of pixels too,
/// which passes all of their samples alike. Those err less with the same places in every pixel.
SamplePattern pattern_of(int samples) {
  return samples == growth ? staggered_pattern(samples) : sample_pattern(samples);
}

class Refinement {
 public:
  Refinement(Tracing& tracing, Preview::Whole& shown, Image& image)
      : tracing_(tracing),
        shown_(shown),
        image_(image),
        finer_(image.width, image.height),
        columns_((image.width + block_side - 1) / block_side),
        parts_(parts_in_block * static_cast<std::size_t>(columns_) *
               static_cast<std::size_t>((image.height + block_side - 1) / block_side)) {}

  /// The parts with the errors that they probably have.
  std::span<const ImagePart> parts() const { return expected_; }

  /// All parts that have pixels.
  std::vector<std::size_t> all() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (pixel_count(i) > 0) indices.push_back(i);
    return indices;
  }

  /// The sum of the parts' squared errors.
  double sum_of_errors() const {
    return std::accumulate(expected_.begin(), expected_.end(), 0.0,
                           [](double sum, const ImagePart& part) { return sum + part.error2; });
  }

  /// The sum with its own uncertainty, which counts where few parts have an error: that of k
  /// squares of normal numbers has a standard deviation of sqrt(2 / k) of itself.
  double squared_error() const {
    const double squares = std::accumulate(
        expected_.begin(), expected_.end(), 0.0,
        [](double sum, const ImagePart& part) { return sum + part.error2 * part.error2; });
    return sum_of_errors() + std::sqrt(2 * squares);
  }

  /// Estimates the errors of parts whose samples were compared with none: of one sample, or in
  /// blocks that were not traced with one for each pixel.
  void estimate_the_rest(const std::vector<char>& is_block_traced) {
    expected_.resize(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::size_t block = i / parts_in_block;
      const bool is_coarse = !is_block_traced.empty() && is_block_traced[block] == 0;
      if (is_coarse && i % parts_in_block > 0) parts_[i].samples = 0;
      if (parts_[i].samples > 1 || pixel_count(i) == 0) continue;
      const Tile tile = tile_of(i);
      const int column = static_cast<int>(block) % columns_;
      const int row = static_cast<int>(block) / columns_;
      expected_[i].error2 = is_coarse ? coarse_error2(image_, column, row) * pixel_count(i)
                                      : estimate_first_error2(image_, tile);
    }
  }

  double mean_samples() const {
    double sum = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      sum += static_cast<double>(parts_[i].samples) * pixel_count(i);
    return sum / (static_cast<double>(image_.width) * image_.height);
  }

  /// Milliseconds to refine these parts, by what samples took last.
  double expected_ms(const std::vector<std::size_t>& chosen) const {
    double samples = 0;
    for (const std::size_t i : chosen)
      samples += static_cast<double>(growth) * parts_[i].samples * part_side * part_side;
    return samples * sample_ms_;
  }

  /// What a sample takes all threads together, known from elsewhere.
  void expect_sample_ms(double ms) { sample_ms_ = ms; }

  /// Gives these parts `growth` times the samples. False if not all were done: time was over, or
  /// it was stopped.
  bool refine(const std::vector<std::size_t>& chosen) {
    if (tracing_.progress.stop || tracing_.is_over_time()) return false;
    const std::vector<Task> tasks = tasks_for(chosen);
    const double begin_ms = tracing_.watch.elapsed_ms();
    std::vector<double> error2(parts_.size());
    std::vector<char> is_done(tasks.size(), 0);
    std::atomic<bool> stop{false};
    std::atomic<std::size_t> done{0};
    std::atomic<std::size_t> not_numbers{0};
    const double thread_sample_ms = sample_ms_ * static_cast<double>(tracing_.pool.thread_count());
    tracing_.pool.run(
        tasks.size(),
        [&](std::size_t i) {
          const Task& task = tasks[i];
          if (tracing_.progress.stop ||
              tracing_.is_over_time(thread_sample_ms * task.sample_count())) {
            stop = true;
            return;
          }
          not_numbers += render_tile(tracing_.tracer, patterns_.at(task.samples),
                                     tracing_.scene.render.transfer, task.tile, &finer_)
                             .not_numbers;
          for (std::size_t k = 0; k < task.part_count; ++k)
            error2[task.parts[k]] =
                estimate_error2(image_, finer_, tile_of(task.parts[k]), task.samples);
          is_done[i] = 1;
          tracing_.report(static_cast<double>(++done) / static_cast<double>(tasks.size()));
        },
        stop);
    shown_.change([&](Image& image) { keep_done(tasks, is_done, error2, image); });
    ++tracing_.passes_done;
    tracing_.beyond.not_numbers += not_numbers;
    expected_ = expected_errors(parts_, columns_);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (pixel_count(i) == 0) expected_[i].error2 = 0;  // beside the image is no detail
    double samples = 0;
    for (std::size_t i = 0; i < tasks.size(); ++i)
      if (is_done[i] != 0) samples += tasks[i].sample_count();
    if (samples > 0) sample_ms_ = (tracing_.watch.elapsed_ms() - begin_ms) / samples;
    return !stop;
  }

 private:
  /// Its pixels, those in the image.
  Tile tile_of(std::size_t part) const {
    const auto block = static_cast<int>(part / parts_in_block);
    const auto in_block = static_cast<int>(part % parts_in_block);
    const int x = block % columns_ * block_side + in_block % parts_across * part_side;
    const int y = block / columns_ * block_side + in_block / parts_across * part_side;
    return {std::min(x, image_.width), std::min(y, image_.height),
            std::min(x + part_side, image_.width), std::min(y + part_side, image_.height)};
  }

  int pixel_count(std::size_t part) const {
    const Tile tile = tile_of(part);
    return (tile.x_end - tile.x_begin) * (tile.y_end - tile.y_begin);
  }

  std::vector<Task> tasks_for(const std::vector<std::size_t>& chosen) {
    constexpr double most_samples = 1 << 14;  // others wait for a task, and so does the clock
    std::vector<Task> tasks;
    std::map<int, std::size_t> open;  // of the block at hand, by samples
    std::size_t block = parts_.size();
    for (const std::size_t part : chosen) {
      if (part / parts_in_block != block) open.clear();
      block = part / parts_in_block;
      const int samples = growth * parts_[part].samples;
      if (!patterns_.contains(samples)) patterns_[samples] = pattern_of(samples);
      const auto found = open.find(samples);
      if (found == open.end() || tasks[found->second].sample_count() >= most_samples) {
        open[samples] = tasks.size();
        tasks.push_back({block_tile(block), samples});
      }
      Task& task = tasks[open[samples]];
      task.tile.parts = static_cast<std::uint16_t>(task.tile.parts | 1U << part % parts_in_block);
      task.parts[task.part_count++] = part;
    }
    return tasks;
  }

  /// Without parts yet.
  Tile block_tile(std::size_t block) const {
    const int x = static_cast<int>(block) % columns_ * block_side;
    const int y = static_cast<int>(block) / columns_ * block_side;
    return {x, y, std::min(x + block_side, image_.width), std::min(y + block_side, image_.height),
            0};
  }

  void keep_done(const std::vector<Task>& tasks, const std::vector<char>& is_done,
                 const std::vector<double>& error2, Image& image) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (is_done[i] == 0) continue;
      for (std::size_t k = 0; k < tasks[i].part_count; ++k) {
        const std::size_t part = tasks[i].parts[k];
        parts_[part] = {tasks[i].samples, error2[part]};
        copy_tile(finer_, tile_of(part), image);
      }
    }
  }

  Tracing& tracing_;
  Preview::Whole& shown_;
  Image& image_;
  Image finer_;
  int columns_;
  std::vector<ImagePart> parts_;  ///< a block's one after another, the blocks row by row
  std::vector<ImagePart> expected_{};
  std::map<int, SamplePattern> patterns_{};
  double sample_ms_ = 0;
};

/// Those to refine next: for the target, or else for half of the error; fewer if there is no time
/// for all.
std::vector<std::size_t> next_parts(const Refinement& refinement, double allowed2, double rest_ms,
                                    int most_samples) {
  constexpr int most_tries = 6;
  const double error2 = refinement.sum_of_errors();
  double bound = allowed2 * error2 / refinement.squared_error();
  for (int i = 0;; ++i) {
    std::vector<std::size_t> parts = parts_to_refine(refinement.parts(), bound, most_samples);
    if (i == most_tries || rest_ms <= 0 || refinement.expected_ms(parts) <= rest_ms) return parts;
    bound = (bound + error2) / 2;
  }
}

/// The image of one sample per pixel, or what a budget allows of it.
std::optional<FirstPicture> first_picture(Tracing& tracing) {
  if (tracing.scene.render.budget_ms) return trace_first_picture(tracing);
  std::optional<Image> image = tracing.pass<float>(1);
  if (!image) return {};
  return FirstPicture{std::move(*image), {}, true};
}

}  // namespace

void refine_to_contract(int most_samples, Tracing& tracing, Rendering& rendering) {
  const RenderSettings& settings = tracing.scene.render;
  const double values = static_cast<double>(rendering.pixel_count) * 3;
  Preview::Whole shown(tracing.progress.preview, rendering.image);
  std::optional<FirstPicture> first = first_picture(tracing);
  rendering.stop = Stop::cancelled;
  if (!first) return;
  shown.change([&](Image& image) { image = std::move(first->image); });

  Refinement refinement(tracing, shown, rendering.image);
  const bool is_shared = !is_one_tile(tracing.scene.camera.width, tracing.scene.camera.height, 1,
                                      tracing.scene.lights.size());
  const std::size_t threads =
      is_shared ? 1 : tracing.pool.thread_count();  // that had no part in it
  refinement.expect_sample_ms(tracing.watch.elapsed_ms() /
                              static_cast<double>(rendering.pixel_count * threads));
  const double allowed2 =
      settings.target_rmse ? *settings.target_rmse * *settings.target_rmse * values : 0;
  const auto error2 = [&] { return refinement.squared_error(); };
  bool is_complete = first->is_whole;
  bool is_compared = false;
  const int samples_everywhere = std::min(probing_samples(tracing.plan.census), most_samples);
  for (int samples = growth; samples <= samples_everywhere && is_complete; samples *= growth) {
    is_complete = refinement.refine(refinement.all());
    is_compared = is_compared || is_complete;
  }
  while (is_complete && is_compared && error2() > allowed2 && !tracing.is_over_time()) {
    const double bound = settings.target_rmse ? allowed2 : error2() / 4;
    const std::vector<std::size_t> parts =
        next_parts(refinement, bound, tracing.rest_ms(), most_samples);
    if (parts.empty()) break;
    is_complete = refinement.refine(parts);
  }
  if (!is_compared) refinement.estimate_the_rest(first->is_traced);
  rendering.samples_per_pixel = refinement.mean_samples();
  rendering.estimated_error = std::sqrt(error2() / values);
  if (tracing.progress.stop)
    rendering.stop = Stop::cancelled;
  else if (is_compared && settings.target_rmse && error2() <= allowed2)
    rendering.stop = Stop::target;
  else
    rendering.stop = settings.budget_ms ? Stop::budget : Stop::samples;
}

}  // namespace raytracer

#include "engine/render/refined_image.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include "engine/image/part_errors.h"
#include "engine/math/block.h"
#include "engine/sample/neighbour_error.h"
#include "engine/scene/scene_size.h"

namespace raytracer {

RefinedImage::RefinedImage(Tracing& tracing, Image& image)
    : tracing_(tracing),
      width_(tracing.scene.camera.width),
      height_(tracing.scene.camera.height),
      columns_((width_ + block_side - 1) / block_side),
      fall_(tracing.plan.census),
      shown_(tracing.progress.preview, image),
      image_(image),
      parts_(parts_in_block * static_cast<std::size_t>(columns_) *
             static_cast<std::size_t>((height_ + block_side - 1) / block_side)) {}

bool RefinedImage::begin(const SamplePattern& pattern) {
  PartErrors errors(width_, height_);
  std::optional<Image> image = tracing_.pass<float>(pattern, &errors);
  if (!image) return false;
  note_first_pass(static_cast<int>(pattern.points.size()));
  shown_.change([&](Image& whole) { whole = std::move(*image); });
  for (std::size_t i = 0; i < parts_.size(); ++i)
    parts_[i] = pattern.has_halves()
                    ? ImagePart{static_cast<int>(pattern.points.size()), errors.all()[i]}
                    : of_one_sample(i);
  expect_errors();
  return true;
}

void RefinedImage::begin(FirstPicture first) {
  note_first_pass(1);
  shown_.change([&](Image& whole) { whole = std::move(first.image); });
  const auto columns = static_cast<std::size_t>(columns_);
  const std::atomic<bool> never{false};
  tracing_.pool.run(
      first.is_traced.size() / columns,
      [&](std::size_t row) {
        for (std::size_t block = row * columns; block < (row + 1) * columns; ++block) {
          const bool is_coarse = first.is_traced[block] == 0;
          const double pixel_error2 =
              is_coarse
                  ? coarse_error2(image_, static_cast<int>(block % columns), static_cast<int>(row))
                  : 0;
          for (std::size_t i = parts_in_block * block; i < parts_in_block * (block + 1); ++i)
            parts_[i] = is_coarse ? ImagePart{0, pixel_error2 * pixel_count(i)} : of_one_sample(i);
        }
      },
      never);
  expect_errors();
  if (first.is_whole) return;
  for (std::size_t i = 0; i < parts_.size(); i += parts_in_block)
    parts_[i].samples = 1;  // it stands for its block
}

void RefinedImage::look_for_missable_spheres() {
  constexpr double sphere_ms = 5e-5;
  if (!(tracing_.plan.census.small_spheres > 0)) return;
  const auto objects = static_cast<double>(count_objects(tracing_.scene));
  if (tracing_.is_over_time(sphere_ms * objects)) return;
  missable_.emplace(tracing_.scene, tracing_.plan.frame);
  expect_errors();
}

double RefinedImage::mean_samples() const {
  double sum = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    sum += static_cast<double>(parts_[i].samples) * pixel_count(i);
  return sum / (static_cast<double>(width_) * height_);
}

std::vector<int> RefinedImage::next_samples(double error2, int most_samples) const {
  double sum = 0;
  for (const ImagePart& part : expected_) sum += part.error2;
  const double part_sample_ms = sample_ms_ * part_side * part_side;
  return raytracer::next_samples(
      expected_, {.error2 = error2 * sum / this->error2(),
                  .samples = std::max(tracing_.rest_ms() - after_ms_, 0.0) / part_sample_ms,
                  .most_samples = most_samples});
}

bool RefinedImage::refine(const std::vector<int>& samples) {
  for (const int count : samples)
    if (count > 0 && !patterns_.contains(count)) patterns_[count] = sample_pattern(count);
  const std::vector<ImagePart> before = parts_;
  const bool is_done = trace(tasks_for(samples));
  fall_.include(before, parts_);
  expect_errors();
  return is_done;
}

bool RefinedImage::refine_all(const SamplePattern& pattern) {
  const auto samples = static_cast<int>(pattern.points.size());
  patterns_[samples] = pattern;
  const bool is_done = trace(tasks_for(std::vector<int>(parts_.size(), samples)));
  patterns_.erase(samples);
  expect_errors();
  return is_done;
}

bool RefinedImage::trace(std::vector<Task> tasks) {
  if (tracing_.progress.stop || tracing_.is_over_time()) return false;
  // What there is no time for should be what would have helped least.
  if (tracing_.scene.render.budget_ms)
    std::stable_sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) {
      return a.error2 * b.sample_count() > b.error2 * a.sample_count();
    });
  if (finer_.values.empty()) finer_ = Image(width_, height_);
  PartErrors errors(width_, height_);
  const double begin_ms = tracing_.watch.elapsed_ms();
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
            tracing_.is_over_time(after_ms_ + thread_sample_ms * task.sample_count())) {
          stop = true;
          return;
        }
        not_numbers += render_tile(tracing_.tracer, patterns_.at(task.samples),
                                   tracing_.scene.render.transfer, task.tile, &finer_, &errors)
                           .not_numbers;
        is_done[i] = 1;
        tracing_.report(static_cast<double>(++done) / static_cast<double>(tasks.size()));
      },
      stop);
  last_sample_ms_ = tracing_.watch.elapsed_ms();
  double samples = 0;
  shown_.change([&](Image& image) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (is_done[i] == 0) continue;
      samples += tasks[i].sample_count();
      for (const std::size_t part : tasks[i].parts) {
        parts_[part] = {tasks[i].samples, errors.all()[part]};
        copy_tile(finer_, tile_of(part), image);
      }
    }
  });
  ++tracing_.passes_done;
  tracing_.beyond.not_numbers += not_numbers;
  if (samples > 0) sample_ms_ = (last_sample_ms_ - begin_ms) / samples;
  return !stop;
}

double RefinedImage::Task::sample_count() const {
  return static_cast<double>(parts.size()) * part_side * part_side * samples;
}

Tile RefinedImage::tile_of(std::size_t part) const {
  const auto block = static_cast<int>(part / parts_in_block);
  const auto in_block = static_cast<int>(part % parts_in_block);
  const int x = block % columns_ * block_side + in_block % parts_across * part_side;
  const int y = block / columns_ * block_side + in_block / parts_across * part_side;
  return {std::min(x, width_), std::min(y, height_), std::min(x + part_side, width_),
          std::min(y + part_side, height_)};
}

int RefinedImage::pixel_count(std::size_t part) const {
  const Tile tile = tile_of(part);
  return (tile.x_end - tile.x_begin) * (tile.y_end - tile.y_begin);
}

std::vector<RefinedImage::Task> RefinedImage::tasks_for(const std::vector<int>& samples) const {
  constexpr double most_samples = 1 << 14;  // others wait for a task, and so does the clock
  std::vector<Task> tasks;
  std::map<int, std::size_t> open;  // of the block at hand, by samples
  for (std::size_t part = 0; part < samples.size(); ++part) {
    if (part % parts_in_block == 0) open.clear();
    if (samples[part] == 0 || pixel_count(part) == 0) continue;
    const auto found = open.find(samples[part]);
    if (found == open.end() || tasks[found->second].sample_count() >= most_samples) {
      open[samples[part]] = tasks.size();
      const int x = static_cast<int>(part / parts_in_block) % columns_ * block_side;
      const int y = static_cast<int>(part / parts_in_block) / columns_ * block_side;
      tasks.push_back(
          {.tile = {x, y, std::min(x + block_side, width_), std::min(y + block_side, height_), 0},
           .samples = samples[part]});
    }
    Task& task = tasks[open[samples[part]]];
    task.tile.parts = static_cast<std::uint16_t>(task.tile.parts | 1U << part % parts_in_block);
    task.parts.push_back(part);
    task.error2 += expected_[part].error2;
  }
  return tasks;
}

ImagePart RefinedImage::of_one_sample(std::size_t part) const {
  // As if halves had shown it, whose excess is taken off.
  return {1, neighbour_error2(image_, tile_of(part)) * fall_.halves_excess()};
}

void RefinedImage::expect_errors() {
  // What is no number has no error that more samples would make less.
  for (ImagePart& part : parts_)
    if (!(part.error2 > 0)) part.error2 = 0;
  expected_ = expected_errors(parts_, width_, height_, fall_.halves_excess());
  if (missable_)
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (parts_[i].samples > 0)
        expected_[i].error2 =
            std::max(expected_[i].error2, missable_->error2(i, parts_[i].samples));
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

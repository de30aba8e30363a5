#include "engine/render/refinement_tasks.h"

#include <algorithm>
#include <numeric>

#include "engine/errors/error_model.h"
#include "engine/math/block.h"

namespace raytracer {
namespace {

/// Pixels of a block that get as many samples, side by side.
void sort_by_samples(std::vector<PixelSamples>& pixels, const PixelErrors& errors) {
  for (auto begin = pixels.begin(); begin != pixels.end();) {
    const std::size_t block = errors.block_of(begin->pixel);
    const auto end = std::find_if(begin, pixels.end(), [&](const PixelSamples& pixel) {
      return errors.block_of(pixel.pixel) != block;
    });
    std::stable_sort(begin, end, [](const PixelSamples& a, const PixelSamples& b) {
      return a.samples < b.samples;
    });
    begin = end;
  }
}

}  // namespace

std::vector<RefinementTask> block_tasks(const PixelErrors& errors, int samples) {
  std::vector<RefinementTask> tasks(errors.block_count());
  for (std::size_t block = 0; block < tasks.size(); ++block) {
    const Tile tile = errors.tile_of(block);
    const int pixels = (tile.x_end - tile.x_begin) * (tile.y_end - tile.y_begin);
    tasks[block].block = block;
    tasks[block].samples = static_cast<double>(samples) * pixels;
    for (std::size_t i = 0; i < subtiles_in_block; ++i)
      tasks[block].error2 += errors.of_subtile(subtiles_in_block * block + i);
  }
  return tasks;
}

std::vector<RefinementTask> pixel_tasks(std::vector<PixelSamples>& pixels,
                                        const PixelErrors& errors) {
  sort_by_samples(pixels, errors);
  std::vector<RefinementTask> tasks;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t block = errors.block_of(pixels[i].pixel);
    const int samples = pixels[i].samples;
    if (tasks.empty() || tasks.back().block != block || tasks.back().samples_per_pixel != samples ||
        tasks.back().samples >= RefinementModel::task_samples)
      tasks.push_back({.block = block, .begin = i, .samples_per_pixel = samples});
    RefinementTask& task = tasks.back();
    task.samples += samples;
    task.error2 += errors.of_pixel(pixels[i].pixel);
    task.end = i + 1;
  }
  return tasks;
}

std::vector<std::size_t> most_useful_first(const std::vector<RefinementTask>& tasks) {
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tasks[a].error2 / tasks[a].samples > tasks[b].error2 / tasks[b].samples;
  });
  return order;
}

}  // namespace raytracer

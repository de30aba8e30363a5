#include "engine/render/refinement_tasks.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "engine/errors/error_model.h"
#include "engine/math/block.h"

namespace raytracer {
namespace {

/// By their samples, and otherwise as they were.
void sort_by_samples(std::vector<PixelSamples>& pixels) {
  std::map<int, std::size_t> places;  // how many get so many samples; then where the next goes
  for (const PixelSamples& pixel : pixels) ++places[pixel.samples];
  std::size_t first = 0;
  for (auto& [samples, place] : places) first += std::exchange(place, first);
  std::vector<PixelSamples> sorted(pixels.size());
  for (const PixelSamples& pixel : pixels) sorted[places.find(pixel.samples)->second++] = pixel;
  pixels.swap(sorted);
}

}  // namespace

std::vector<RefinementTask> block_tasks(const PixelErrors& errors, int samples) {
  std::vector<RefinementTask> tasks(errors.block_count());
  for (std::size_t block = 0; block < tasks.size(); ++block) {
    const auto pixels = static_cast<double>(errors.tile_of(block).pixel_count());
    tasks[block].samples = samples * pixels;
    for (std::size_t i = 0; i < subtiles_in_block; ++i)
      tasks[block].error2 += errors.of_subtile(subtiles_in_block * block + i);
  }
  return tasks;
}

std::vector<RefinementTask> pixel_tasks(std::vector<PixelSamples>& pixels,
                                        const PixelErrors& errors) {
  sort_by_samples(pixels);
  double all = 0;
  for (const PixelSamples& pixel : pixels) all += pixel.samples;
  // The same for any number of threads: where rays branch, those that are traced together are added
  // up in an order that all of them make.
  const double most =
      std::clamp(all / RefinementModel::tasks_per_pass, RefinementModel::least_task_samples,
                 RefinementModel::task_samples);
  std::vector<RefinementTask> tasks;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int samples = pixels[i].samples;
    if (tasks.empty() || tasks.back().samples_per_pixel != samples || tasks.back().samples >= most)
      tasks.push_back({.begin = i, .samples_per_pixel = samples});
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

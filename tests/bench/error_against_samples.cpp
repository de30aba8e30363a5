// What accuracy costs: error and time of one scene for growing numbers of samples, as a Markdown
// table on standard output.
//
//   error_against_samples SCENE.json [WIDTH HEIGHT]
//
// The errors are against the same scene at 4096 samples per pixel, before rounding to 8 bits. A
// time is the median of five renders, the sample counts taken in turn.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <thread>

#include "engine/engine.h"

namespace {

using namespace raytracer;

constexpr int reference_samples = 4096;
constexpr std::array sample_counts{1, 2, 4, 8, 16, 32, 64, 128, 256};

struct Difference {
  double rmse;
  double largest;
  double share_visible;  ///< of pixels with a channel off by more than 1/255
};

Difference compare(const Image& image, const Image& exact) {
  double squares = 0;
  double largest = 0;
  std::size_t visible = 0;
  for (std::size_t pixel = 0; pixel < image.values.size(); pixel += 3) {
    double pixel_largest = 0;
    for (std::size_t i = pixel; i < pixel + 3; ++i) {
      const double difference = std::abs(double{image.values[i]} - double{exact.values[i]});
      squares += difference * difference;
      pixel_largest = std::max(pixel_largest, difference);
    }
    largest = std::max(largest, pixel_largest);
    if (pixel_largest > 1.0 / 255) ++visible;
  }
  const auto count = static_cast<double>(image.values.size());
  return {std::sqrt(squares / count), largest, 3 * static_cast<double>(visible) / count};
}

Rendering render_with(Scene scene, int samples, WorkerPool& pool) {
  scene.render.samples = samples;
  scene.render.target_rmse.reset();
  scene.render.budget_ms.reset();
  RenderProgress progress;
  return render(scene, Limits{}, pool, progress);
}

void print_table(const Scene& scene) {
  constexpr int repetitions = 5;
  WorkerPool pool(std::thread::hardware_concurrency());
  const Image exact = render_with(scene, reference_samples, pool).image;
  std::array<std::array<double, repetitions>, sample_counts.size()> times_ms{};
  std::array<Difference, sample_counts.size()> differences{};
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t i = 0; i < sample_counts.size(); ++i) {
      const Rendering rendering = render_with(scene, sample_counts[i], pool);
      times_ms[i][static_cast<std::size_t>(repetition)] = rendering.trace_ms;
      differences[i] = compare(rendering.image, exact);
    }
  }
  fmt::print("{} x {}, {} threads, against {} samples per pixel\n\n", scene.camera.width,
             scene.camera.height, pool.thread_count(), reference_samples);
  fmt::print("| samples | trace, ms | rmse | largest | pixels off by > 1/255 |\n");
  fmt::print("|--:|--:|--:|--:|--:|\n");
  for (std::size_t i = 0; i < sample_counts.size(); ++i) {
    std::sort(times_ms[i].begin(), times_ms[i].end());
    fmt::print("| {} | {:.1f} | {:.4f} | {:.2f} | {:.1f} % |\n", sample_counts[i],
               times_ms[i][repetitions / 2], differences[i].rmse, differences[i].largest,
               100 * differences[i].share_visible);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2 && argc != 4) {
    std::cerr << "usage: error_against_samples SCENE.json [WIDTH HEIGHT]\n";
    return 1;
  }
  std::ifstream file(argv[1], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  Overrides overrides;
  if (argc == 4) {
    overrides.width = std::atoi(argv[2]);  // 0 where it is no number, which read_scene refuses
    overrides.height = std::atoi(argv[3]);
  }
  const auto scene = read_scene(text, Limits{}, overrides);
  if (!scene.ok()) {
    for (const auto& error : scene.errors())
      std::cerr << argv[1] << ": " << error.pointer << ": " << error.detail << '\n';
    return 1;
  }
  print_table(scene.value());
  return 0;
} catch (const std::exception& error) {
  std::cerr << "error_against_samples: " << error.what() << '\n';
  return 1;
}

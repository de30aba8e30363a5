#include "engine/sample/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/overrides.h"

namespace raytracer {
namespace {

constexpr int shrinkage_log2 = 3;  // of growth^3/2, by which a part's squared error shrinks

/// Errors per sample by powers of the fourth root of two, from 2^-128 on.
constexpr int steps_per_octave = 4;
constexpr int step_count = 128 * steps_per_octave;
// A refined part's error per sample is less by both.
constexpr int steps_per_refinement = 5 * steps_per_octave;

int step_of(const ImagePart& part) {
  const double octaves = std::log2(part.error2 / part.samples) + 128;
  return std::clamp(static_cast<int>(octaves * steps_per_octave), 0, step_count - 1);
}

}  // namespace

int most_samples(const Scene& scene, const Limits& limits) {
  constexpr double share_of_last = 1 - 1.0 / growth;  // of 1 + growth + growth^2 + ...
  const double by_work = share_of_last * static_cast<double>(limits.work) / count_rays(scene, 1);
  return static_cast<int>(std::clamp(std::min(by_work, static_cast<double>(limits.samples)), 1.0,
                                     static_cast<double>(1 << 30)));
}

int probing_samples(const Census& census) {
  return census.small_spheres > 0 ? growth * growth : growth;
}

double estimate_error2(const Image& coarser, const Image& finer, const Tile& part,
                       int finer_samples) {
  double sum = 0;
  for (int y = part.y_begin; y < part.y_end; ++y) {
    const float* const a = coarser.pixel(part.x_begin, y);
    const float* const b = finer.pixel(part.x_begin, y);
    for (int i = 0; i < 3 * (part.x_end - part.x_begin); ++i) {
      const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      sum += difference * difference;
    }
  }
  return sum / (finer_samples > growth ? growth : 2);
}

double estimate_first_error2(const Image& image, const Tile& part) {
  constexpr double share = 1.0 / 8;
  double sum = 0;
  const auto add = [&](const float* a, const float* b) {
    for (int i = 0; i < 3; ++i) {
      const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      sum += difference * difference;
    }
  };
  for (int y = part.y_begin; y < part.y_end; ++y) {
    for (int x = part.x_begin; x < part.x_end; ++x) {
      const float* const pixel = image.pixel(x, y);
      if (x + 1 < image.width) add(pixel, image.pixel(x + 1, y));
      if (y + 1 < image.height) add(pixel, image.pixel(x, y + 1));
    }
  }
  return share * sum;
}

std::vector<ImagePart> expected_errors(std::span<const ImagePart> parts, int columns) {
  constexpr double share = 0.1;
  const int width = parts_across * columns;
  const int height = static_cast<int>(parts.size()) / parts_across / columns;
  const auto index = [&](int x, int y) {
    return parts_in_block *
               static_cast<std::size_t>(y / parts_across * columns + x / parts_across) +
           static_cast<std::size_t>(y % parts_across * parts_across + x % parts_across);
  };
  // What errors have in common at all numbers of samples, with a rim of nothing.
  const std::size_t stride = static_cast<std::size_t>(width) + 2;
  std::vector<double> detail(stride * (static_cast<std::size_t>(height) + 2), 0.0);
  const auto place = [&](int x, int y) {
    return static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const ImagePart& part = parts[index(x, y)];
      detail[place(x, y)] = part.error2 * part.samples * std::sqrt(part.samples);
    }
  std::vector<ImagePart> expected(parts.begin(), parts.end());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t at = place(x, y);
      double sum = -detail[at];
      for (const std::size_t row : {at - stride, at, at + stride})
        sum += detail[row - 1] + detail[row] + detail[row + 1];
      ImagePart& part = expected[index(x, y)];
      part.error2 =
          std::max(part.error2, share * sum / 8 / (part.samples * std::sqrt(part.samples)));
    }
  return expected;
}

std::vector<std::size_t> parts_to_refine(std::span<const ImagePart> parts, double bound,
                                         int most_samples) {
  std::array<double, step_count> error2_by_step{};
  double rest = 0;  // that nothing can be done about
  double sum = 0;
  const auto can_grow = [&](const ImagePart& part) {
    return part.error2 > 0 && part.samples <= most_samples / growth;
  };
  for (const ImagePart& part : parts) {
    sum += part.error2;
    if (can_grow(part))
      error2_by_step[static_cast<std::size_t>(step_of(part))] += part.error2;
    else
      rest += part.error2;
  }
  if (sum <= bound) return {};

  /// What is left when all parts are refined until their errors per sample are below `level`.
  const auto left_at = [&](int level) {
    double left = rest;
    for (int step = 0; step < step_count; ++step) {
      const int above = std::max(step - level, 0);
      const int refinements = (above + steps_per_refinement - 1) / steps_per_refinement;
      left +=
          std::ldexp(error2_by_step[static_cast<std::size_t>(step)], -shrinkage_log2 * refinements);
    }
    return left;
  };
  // The highest that is low enough; at -1 all are refined that have an error.
  int level = -1;
  for (int too_high = step_count - 1; too_high - level > 1;) {
    const int middle = (level + too_high) / 2;
    (left_at(middle) <= bound ? level : too_high) = middle;
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (can_grow(parts[i]) && step_of(parts[i]) > level) chosen.push_back(i);
  return chosen;
}

}  // namespace raytracer

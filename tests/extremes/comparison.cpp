#include "tests/extremes/comparison.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace raytracer::extremes {
namespace {

constexpr double edge_px = 1e-6;
constexpr int most_displacements = 8;

/// In levels of 255.
double difference(const Vec3& a, const Vec3& b) { return 255 * max_abs(a - b); }

/// Whether the exact picture has this colour somewhere `away` from the image point.
bool is_seen_near(const Oracle& oracle, double x, double y, double away, const Vec3& color) {
  constexpr int directions = 8;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * 3.141592653589793 * i / directions;
    const Vec3 seen = oracle.color(x, y, away * std::cos(angle), away * std::sin(angle));
    if (difference(seen, color) <= 1) return true;
  }
  return false;
}

double displacement(const Oracle& oracle, double x, double y, const Vec3& color) {
  constexpr int doublings = 23;  // to more than 4 pixels
  double away = edge_px;
  for (int i = 0; i < doublings; ++i) {
    if (is_seen_near(oracle, x, y, away, color)) return away;
    away *= 2;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

ExactImage exact_image(const Scene& scene, WorkerPool& pool) {
  const Oracle oracle(scene);
  const int width = scene.camera.width;
  const int height = scene.camera.height;
  ExactImage image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const std::atomic<bool> stop{false};
  pool.run(
      image.size(),
      [&](std::size_t i) {
        const auto x = static_cast<int>(i % static_cast<std::size_t>(width));
        const auto y = static_cast<int>(i / static_cast<std::size_t>(width));
        image[i] = oracle.color(x + 0.5, height - y - 0.5);
      },
      stop);
  return image;
}

Comparison compare(const Image& image, const ExactImage& exact, const Scene& scene) {
  const Oracle oracle(scene);
  Comparison result;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* pixel = image.pixel(x, y);
      const Vec3 color{pixel[0], pixel[1], pixel[2]};
      if (std::isnan(color.x) || std::isnan(color.y) || std::isnan(color.z)) ++result.nans;
      const double levels = difference(
          color, exact[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x)]);
      if (levels <= 1) {
        result.levels = std::max(result.levels, levels);
        continue;
      }
      const double image_y = image.height - y - 0.5;
      if (is_seen_near(oracle, x + 0.5, image_y, edge_px, color)) {
        ++result.at_edge;
        result.displacement_px = std::max(result.displacement_px, edge_px);
        continue;
      }
      // Looking for where it is seen takes long: in a picture with many such, only for some.
      if (result.off++ < most_displacements)
        result.displacement_px =
            std::max(result.displacement_px, displacement(oracle, x + 0.5, image_y, color));
    }
  }
  return result;
}

}  // namespace raytracer::extremes

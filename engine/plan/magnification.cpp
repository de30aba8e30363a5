#include "engine/plan/magnification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace raytracer {
namespace {

/// The spheres that mirror, in frame coordinates.
struct Mirrors {
  double count = 0;
  double smallest = std::numeric_limits<double>::infinity();  ///< radius
  double radius_sum = 0;
  double low = std::numeric_limits<double>::infinity();    ///< of all coordinates, so that high
  double high = -std::numeric_limits<double>::infinity();  ///< - low is the space they stand in

  void include(const Vec3& center, double radius, double number, double reach) {
    count += number;
    smallest = std::min(smallest, radius);
    radius_sum += number * radius;
    for (const double place : {center.x, center.y, center.z}) {
      low = std::min(low, place - reach);
      high = std::max(high, place + reach);
    }
  }
};

Mirrors find_mirrors(const Scene& scene, const Frame& frame) {
  Mirrors mirrors;
  for (const Object& object : scene.objects) {
    if (!(scene.materials[object.material].reflectivity > 0)) continue;
    const auto add = [&](const Vec3& center, double radius, double number, double reach) {
      if (!Frame::carries(frame.frame_from_scene(radius))) return;
      mirrors.include(frame.frame_from_scene(center), frame.frame_from_scene(radius), number,
                      frame.frame_from_scene(reach));
    };
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      add(sphere->center, sphere->radius, 1, sphere->radius);
    } else if (const auto* square = std::get_if<SphereSquare>(&object.shape)) {
      const double side = 2 * static_cast<double>(square->n);
      add(square->center, square->radius, side * side, std::min(side * square->radius, 1e308));
    } else if (const auto* spheres = std::get_if<Spheres>(&object.shape)) {
      for (std::size_t i = 0; i < spheres->centers.size(); ++i)
        add(spheres->centers[i], spheres->radius(i), 1, spheres->radius(i));
    }
  }
  return mirrors;
}

}  // namespace

double magnification(const Scene& scene, const Frame& frame, const Features& features,
                     double farthest) {
  const Mirrors mirrors = find_mirrors(scene, frame);
  if (mirrors.count == 0) return 1;
  const double first = features.reflectivity * 2 * farthest / mirrors.smallest;
  double further = 0;
  if (mirrors.count > 1) {
    const double width = mirrors.high - mirrors.low;
    const double radius = mirrors.radius_sum / mirrors.count;
    const double free_path =
        width / (mirrors.count - 1) * (width / radius) * (width / radius) / std::numbers::pi;
    const double step = std::min(free_path, width);
    further = features.reflectivity * step / free_path * 2 * step / radius;
  }
  return std::max(first, 1.0) * std::pow(std::max(further, 1.0), features.max_depth - 1);
}

}  // namespace raytracer

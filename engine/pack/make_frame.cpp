#include "engine/pack/make_frame.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace raytracer {
namespace {

/// A quarter of the extent around the eye, which may be more than a double holds.
double quarter_extent(const Scene& scene, const Vec3& eye) {
  double extent = 0;
  const auto include = [&](const Vec3& point, double reach) {
    extent = std::max(extent, max_abs(point * 0.25 - eye * 0.25) + reach * 0.25);
  };
  for (const Object& object : scene.objects)
    std::visit([&](const auto& shape) { for_each_extent(shape, include); }, object.shape);
  for (const Light& light : scene.lights)
    std::visit([&](const auto& source) { for_each_extent(source, include); }, light.source);
  return extent;
}

}  // namespace

Frame make_frame(const Scene& scene) {
  const Vec3 eye = scene.camera.origin;
  const double extent = quarter_extent(scene, eye);
  if (extent == 0) return {eye, 0};
  return {eye, std::ilogb(extent) + 2};
}

}  // namespace raytracer

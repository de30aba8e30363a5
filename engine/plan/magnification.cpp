#include "engine/plan/magnification.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/plan/scene_statistics.h"

namespace raytracer {
namespace {

/// One whose corners' normals differ mirrors as a sphere would whose normals turn as fast.
template <typename Primitive>
void add_smooth_mirror(const PackedScene& packed, const Primitive& primitive,
                       CurvedMirrors& mirrors) {
  if constexpr (HasCorners<Primitive>) {
    const double radius = smooth_radius(packed, primitive);
    if (std::isinf(radius)) return;
    const auto& [a, b, c] = corners_of(primitive);
    mirrors.include((a + b + c) / 3, radius, 1, std::max(length(b - a), length(c - a)));
  }
}

CurvedMirrors find_mirrors(const PackedScene& packed) {
  CurvedMirrors mirrors;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    for (const auto& primitive : of_kind<Kind>(packed.primitives))
      if (const Material& material = packed.material_of(primitive.id);
          material.reflectivity > 0 || material.transparency > 0) {
        add_mirror(primitive, mirrors);
        add_smooth_mirror(packed, primitive, mirrors);
      }
  });
  return mirrors;
}

}  // namespace

double magnification(const PackedScene& packed, const Features& features, double farthest) {
  const CurvedMirrors mirrors = find_mirrors(packed);
  if (mirrors.count == 0) return 1;
  // A lens turns rays no more than a mirror does.
  const double share = std::max(features.reflectivity, features.transparency);
  const double first = share * 2 * farthest / mirrors.smallest;
  double further = 0;
  if (mirrors.count > 1) {
    const double width = max_abs(mirrors.high - mirrors.low);
    const double radius = mirrors.radius_sum / mirrors.count;
    const double free_path =
        width / (mirrors.count - 1) * (width / radius) * (width / radius) / std::numbers::pi;
    const double step = std::min(free_path, width);
    further = share * step / free_path * 2 * step / radius;
  }
  return std::max(first, 1.0) * std::pow(std::max(further, 1.0), features.max_depth - 1);
}

}  // namespace raytracer

// A sphere as a point light sees it.
#pragma once

#include <limits>

#include "engine/pack/packed_scene.h"

namespace raytracer {

/// What hides the light from a point, of a sphere. Relative to the light, in double up to the last
/// step: what is near the light would be lost in the coordinates of what is far.
struct LitSphere {
  Vec3 center;
  double radius2;
  double nearest;  ///< least distance of the surface from the light, negative around it

  /// In whose surface the light lies, to precision T, is a little smaller: it does not hide the
  /// light from outside.
  template <typename T>
  static LitSphere seen_from(const Vec3& light, const PackedSphere& sphere) {
    constexpr double noise = 4096 * static_cast<double>(std::numeric_limits<T>::epsilon());
    const Vec3 center = sphere.center - light;
    const double distance = length(center);
    const bool is_in_surface = std::abs(distance - sphere.radius) <= noise * distance;
    const double radius = is_in_surface ? (1 - noise) * distance : sphere.radius;
    return {center, radius * radius, distance - radius};
  }
};

}  // namespace raytracer

// A sphere as a point light sees it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/pack/packed_scene.h"

namespace raytracer {

/// Whether a light is so far from the eye that its distance would swallow what the spheres' places
/// differ by. Of such a light none is beyond or around it.
inline bool is_far_light(const Vec3& light, std::span<const PackedSphere> spheres) {
  constexpr double far = 4;
  double reach = 0;
  for (const PackedSphere& sphere : spheres)
    reach = std::max(reach, length(sphere.center) + sphere.radius);
  return length(light) > far * reach;
}

/// What hides the light from a point, of a sphere; in double up to the last step.
struct LitSphere {
  Vec3 center;  ///< relative to the light, or to the eye if the light is far
  double radius2;
  double nearest;  ///< least distance of the surface from the light, negative around it

  /// In whose surface the light lies is a little smaller, by what T rounds: it does not hide the
  /// light from outside.
  template <typename T>
  static LitSphere seen_from(const Vec3& light, bool is_far, const PackedSphere& sphere) {
    constexpr double noise = 4096 * std::numeric_limits<double>::epsilon();
    constexpr double shrink = 1 - 4096 * static_cast<double>(std::numeric_limits<T>::epsilon());
    const Vec3 from_light = sphere.center - light;
    const double distance = length(from_light);
    const bool is_in_surface = std::abs(distance - sphere.radius) <= noise * distance;
    const double radius = is_in_surface ? shrink * distance : sphere.radius;
    return {is_far ? sphere.center : from_light, radius * radius, distance - radius};
  }
};

}  // namespace raytracer

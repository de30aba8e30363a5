// Light from infinitely far away, travelling along a direction.
//
//   { "type": "distant", "direction": [-0.6, -1, 0.7], "color": [1, 1, 1], "intensity": 0.9 }
#pragma once

#include <string_view>
#include <tuple>

#include "engine/lights/light_kind.h"

namespace raytracer {

struct DistantLight {
  Vec3 direction;  ///< not zero, any length

  static constexpr std::string_view type = "distant";
  static constexpr std::string_view description = "From infinitely far away.";
  static constexpr auto fields = std::tuple(required(
      "direction", &DistantLight::direction, DirectionRule{}, "Where the light travels to."));
  static constexpr LightRays rays = LightRays::parallel;
};

template <typename Include>
void for_each_extent(const DistantLight&, const Include&) {}

inline Vec3 place_of(const DistantLight& light, const Frame&) { return -unit(light.direction); }
inline Rgb emission_of(const DistantLight&, const Rgb& i, const Frame&) { return i; }

inline bool fades(const DistantLight&) { return false; }

inline double brightest(const DistantLight&, double i, double /*clearance*/) { return i; }

inline ArrivingLight arriving(std::type_identity<DistantLight>, const PackedLight& light,
                              const SurfacePoint&) {
  return {light.place, infinity, light.emission};
}

}  // namespace raytracer

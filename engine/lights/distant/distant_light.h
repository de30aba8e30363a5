// Light from infinitely far away, travelling along a direction; with an angle, from a disc.
//
//   { "type": "distant", "direction": [-0.6, -1, 0.7], "color": [1, 1, 1], "intensity": 0.9 }
//   { "type": "distant", "direction": [-0.6, -1, 0.7], "angle": 0.0093 }
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "engine/lights/light_kind.h"

namespace raytracer {

struct DistantLight {
  Vec3 direction;    ///< not zero, any length
  double angle = 0;  ///< its diameter as seen from anywhere, in radians; below pi

  static constexpr std::string_view type = "distant";
  static constexpr std::string_view description = "From infinitely far away.";
  static constexpr auto fields =
      std::tuple(required("direction", &DistantLight::direction, DirectionRule{},
                          "Where the light travels to."),
                 optional("angle", &DistantLight::angle,
                          NumberRule{{.least = 0, .most = std::numbers::pi, .most_excluded = true}},
                          "Its diameter as seen from anywhere, in radians: soft shadows."));
};

inline LightRays rays_of(const DistantLight&) { return LightRays::parallel; }
inline LightShape shape_of(const DistantLight& light) {
  return light.angle > 0 ? LightShape::disc : LightShape::point;
}
inline double size_of(const DistantLight& light, const Frame&) { return std::tan(light.angle / 2); }

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

// Light from a point, or a disc around one that faces what it shines on; its intensity is spread
// over 4 pi distance^2, or is the same everywhere.
//
//   { "type": "point", "position": [0, 10, 0], "color": "#ffeedd", "intensity": 1500 }
//   { "type": "point", "position": [0, 10, 0], "intensity": 0.8, "falloff": "none" }
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <tuple>

#include "engine/lights/light_kind.h"

namespace raytracer {

enum class Falloff : std::uint8_t { inverse_square, none };

struct PointLight {
  Vec3 position;
  Falloff falloff = Falloff::inverse_square;
  double radius = 0;

  static constexpr std::string_view type = "point";
  static constexpr std::string_view description =
      "From a point: its intensity is spread over 4 pi distance^2, or arrives whole everywhere.";
  static constexpr auto fields =
      std::tuple(required("position", &PointLight::position, PointRule{}),
                 optional("falloff", &PointLight::falloff, ChoiceRule{"inverse_square", "none"},
                          "Whether it falls with the distance."),
                 optional("radius", &PointLight::radius, NumberRule{not_negative},
                          "Of the disc that shines: soft shadows."));
};

inline LightRays rays_of(const PointLight& light) {
  return light.radius > 0 ? LightRays::neither : LightRays::converging;
}
inline LightShape shape_of(const PointLight& light) {
  return light.radius > 0 ? LightShape::disc : LightShape::point;
}
inline double size_of(const PointLight& light, const Frame& frame) {
  return std::ldexp(light.radius, -frame.exponent());
}

template <typename Include>
void for_each_extent(const PointLight& light, const Include& include) {
  include(light.position, light.radius);
}

inline Vec3 place_of(const PointLight& light, const Frame& frame) {
  return frame.frame_from_scene(light.position);
}
inline bool fades(const PointLight& light) { return light.falloff == Falloff::inverse_square; }

/// Distances in the frame are 2^-exponent times the scene's, and light falls with the square.
inline Rgb emission_of(const PointLight& light, const Rgb& i, const Frame& frame) {
  if (!fades(light)) return i;
  return scaled(i / (4 * std::numbers::pi), -2 * frame.exponent());
}

inline double brightest(const PointLight& light, double i, double clearance) {
  if (!fades(light)) return i;
  return i / (4 * std::numbers::pi) / clearance / clearance;
}

inline ArrivingLight arriving(std::type_identity<PointLight>, const PackedLight& light,
                              const SurfacePoint& point) {
  const Vec3 path = (light.place - point.anchor) - point.offset;
  const double distance = length(path);
  if (!light.fades) return {unit(path), distance, light.emission};
  // 0 / 0 where a channel is dark and the light at the point: dark.
  const auto fallen = [&](double emission) {
    return emission > 0 ? emission / distance / distance : 0;
  };
  return {unit(path),
          distance,
          {fallen(light.emission.x), fallen(light.emission.y), fallen(light.emission.z)}};
}

}  // namespace raytracer

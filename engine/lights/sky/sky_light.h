// Light from everywhere, as far as nothing near hides it: what is known as ambient occlusion.
//
//   { "type": "sky", "color": [0.9, 0.95, 1], "intensity": 0.8, "reach": 5 }
#pragma once

#include <cmath>
#include <string_view>
#include <tuple>

#include "engine/lights/light_kind.h"

namespace raytracer {

struct SkyLight {
  double reach = infinity;  ///< what is farther hides nothing

  static constexpr std::string_view type = "sky";
  static constexpr std::string_view description = "From everywhere.";
  static constexpr auto fields =
      std::tuple(optional("reach", &SkyLight::reach, NumberRule{positive},
                          "What is farther away hides nothing of it."));
  static constexpr bool shines_from_everywhere = true;
};

template <typename Include>
void for_each_extent(const SkyLight&, const Include&) {}

inline LightRays rays_of(const SkyLight& light) {
  return light.reach < infinity ? LightRays::neither : LightRays::parallel;
}
inline LightShape shape_of(const SkyLight&) { return LightShape::sky; }
inline double size_of(const SkyLight& light, const Frame& frame) {
  return std::ldexp(light.reach, -frame.exponent());
}

inline Vec3 place_of(const SkyLight&, const Frame&) { return {}; }
inline Rgb emission_of(const SkyLight&, const Rgb& i, const Frame&) { return i; }
inline bool fades(const SkyLight&) { return false; }
inline double brightest(const SkyLight&, double i, double /*clearance*/) { return i; }

}  // namespace raytracer

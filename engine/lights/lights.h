// The kinds of lights, each in a folder beside this file: the one list of them.
#pragma once

#include <cstdint>
#include <tuple>
#include <variant>

#include "engine/fields/types.h"
#include "engine/lights/distant/distant_light.h"
#include "engine/lights/light_kind.h"
#include "engine/lights/point/point_light.h"
#include "engine/lights/sky/sky_light.h"

namespace raytracer {

/// Those that shine from everywhere last.
using LightKinds = Types<DistantLight, PointLight, SkyLight>;
static_assert(each_satisfies<LightKinds>([]<LightKind Kind>(std::type_identity<Kind>) {}));

struct Light {
  LightKinds::In<std::variant> source;
  Rgb color{1, 1, 1};
  double intensity = 1;  ///< >= 0

  /// Those of lights of every kind.
  static constexpr auto fields =
      std::tuple(optional("color", &Light::color, ColorRule{}),
                 optional("intensity", &Light::intensity, NumberRule{not_negative}));
};

/// What a surface that a light does not reach shows of that light's ambient part; `off`: every
/// light reaches every surface that faces it.
enum class Shadows : std::uint8_t { black, ambient, off };

inline LightRays rays_of(const Light& light) {
  return std::visit([](const auto& kind) { return rays_of(kind); }, light.source);
}

inline LightShape shape_of(const Light& light) {
  return std::visit([](const auto& kind) { return shape_of(kind); }, light.source);
}

inline bool is_soft(const Light& light) { return shape_of(light) != LightShape::point; }

inline PackedLight pack_light(const Light& light, const Frame& frame) {
  return std::visit(
      [&](const auto& kind) -> PackedLight {
        return {light.source.index(),  rays_of(kind),
                place_of(kind, frame), emission_of(kind, light.color * light.intensity, frame),
                fades(kind),           shape_of(kind),
                size_of(kind, frame)};
      },
      light.source);
}

}  // namespace raytracer

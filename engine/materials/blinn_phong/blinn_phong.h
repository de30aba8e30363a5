// How a surface answers light: ambient, diffuse and specular parts (Blinn: "Models of light
// reflection for computer synthesized pictures", SIGGRAPH 1977).
//
//   { "color": [0.9, 0.2, 0.2], "ka": 1, "kd": 0.7, "ks": 0.3, "shininess": 50 }
#pragma once

#include <tuple>

#include "engine/fields/field_table.h"
#include "engine/lights/light_kind.h"
#include "engine/math/vec.h"

namespace raytracer {

struct BlinnPhong {
  Rgb color{1, 1, 1};
  double ka = 1;
  double kd = 0.7;
  double ks = 0.3;
  double shininess = 50;

  static constexpr auto fields =
      std::tuple(optional("color", &BlinnPhong::color, ColorRule{}),
                 optional("ka", &BlinnPhong::ka, NumberRule{unit_interval}, "Ambient part."),
                 optional("kd", &BlinnPhong::kd, NumberRule{unit_interval}, "Diffuse part."),
                 optional("ks", &BlinnPhong::ks, NumberRule{unit_interval}, "Specular part."),
                 optional("shininess", &BlinnPhong::shininess, NumberRule{not_negative},
                          "The highlight's exponent."));

  friend auto operator<=>(const BlinnPhong&, const BlinnPhong&) = default;
};

/// color * (kd (N.L) + ks max(0, H.N)^shininess) * i, for N.L > 0; all vectors are unit, `view`
/// towards the viewer.
Rgb direct_light(const BlinnPhong& material, const ArrivingLight& light, const Vec3& normal,
                 const Vec3& view);

}  // namespace raytracer

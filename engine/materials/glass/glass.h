// A surface that lets rays through: what has an inside bends them by Snell's law, with its index of
// refraction inside and 1 outside.
//
//   { "transparency": 0.9, "ior": 1.5, "fresnel": true }
//
// Where a ray would leave the inside beyond the critical angle, all of it is reflected. With
// `fresnel` the share that is reflected of unpolarised light at the ray's angle goes to the mirror
// and does not go on.
#pragma once

#include <tuple>

#include "engine/fields/field_table.h"
#include "engine/math/vec.h"

namespace raytracer {

struct Glass {
  double transparency = 0;
  double ior = 1.5;
  bool fresnel = false;

  static constexpr auto fields =
      std::tuple(optional("transparency", &Glass::transparency, NumberRule{unit_interval},
                          "How much of what is behind it a surface shows."),
                 optional("ior", &Glass::ior, NumberRule{{.least = 1}},
                          "The index of refraction of its inside."),
                 optional("fresnel", &Glass::fresnel, FlagRule{},
                          "Whether what goes on and what is mirrored depend on the angle."));

  friend auto operator<=>(const Glass&, const Glass&) = default;
};

/// How a ray goes on.
struct RefractedRay {
  Vec3 direction;  ///< unit
  /// Fresnel's, if the material asks for it: the share that does not go on.
  double reflectance = 0;
  bool is_total = false;  ///< nothing goes on: all of it is reflected
};

/// Through a surface whose `surface_normal` faces the ray and which `normal` shades: a ray that
/// this would not take to the other side takes the surface's.
RefractedRay refracted(const Glass& glass, const Vec3& direction, const Vec3& normal,
                       const Vec3& surface_normal, bool is_inside);

}  // namespace raytracer

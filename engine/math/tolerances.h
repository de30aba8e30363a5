// What rounding may be held to account for: the same in the kernels, in their precision T, and in
// the reference, in double, which have to draw the same lines.
#pragma once

#include <limits>

#include "engine/math/vec.h"

namespace raytracer {

/// Of a number, what storing it in T changes at most: half a unit in the last place of 1 (IEEE
/// 754).
template <typename T>
inline constexpr T unit_roundoff = std::numeric_limits<T>::epsilon() / 2;

/// The sine of an angle to a plane, of unit vectors, that may be that of none: a few roundings.
template <typename T>
inline constexpr T sine_noise = 4 * std::numeric_limits<T>::epsilon();

/// What a ray meets nearer than this share of a light's distance hides the light, where that is
/// looked for from the points: one that lies in a surface is not hidden by that, for there the
/// distances are the same but for rounding.
template <typename T>
inline constexpr T nearer_than_light = 1 - 4096 * std::numeric_limits<T>::epsilon();

/// Whether a light is so far from the eye, against how far the primitives reach, that its distance
/// would swallow what their places differ by. Of such a light none is beyond or around it.
inline bool is_far_light(const Vec3& light, double reach) {
  constexpr double far = 4;
  return length(light) > far * reach;
}

}  // namespace raytracer

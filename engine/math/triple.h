// Numbers in a kernel's precision T.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/math/vec.h"

namespace raytracer {

/// Three coordinates, or the channels of a colour.
template <typename T>
struct Triple {
  T x;
  T y;
  T z;
};

template <typename T>
Triple<T> narrowed(const Vec3& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

/// At most the largest T.
template <typename T>
T finite(double value) {
  return static_cast<T>(std::min<double>(value, std::numeric_limits<T>::max()));
}

/// At most so large that the sum over all lights, times any share, stays finite.
template <typename T>
T saturated(double channel) {
  constexpr double most = std::numeric_limits<T>::max() / 1e6;
  return static_cast<T>(std::min(channel, most));
}
template <typename T>
Triple<T> saturated(const Rgb& color) {
  return {saturated<T>(color.x), saturated<T>(color.y), saturated<T>(color.z)};
}

}  // namespace raytracer

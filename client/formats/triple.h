// Points and directions of files, in double precision.
#pragma once

#include <algorithm>
#include <cmath>

#include "client/formats/scene_model.h"

namespace raytracer::client {

inline double dot(const model::Triple& a, const model::Triple& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline model::Triple cross(const model::Triple& a, const model::Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline model::Triple scaled(const model::Triple& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

inline model::Triple sum(const model::Triple& a, const model::Triple& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline model::Triple difference(const model::Triple& a, const model::Triple& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// By its largest component first, so that no square overflows.
inline model::Triple unit(const model::Triple& a) {
  const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  const model::Triple moderate{a[0] / largest, a[1] / largest, a[2] / largest};
  return scaled(moderate, 1 / std::sqrt(dot(moderate, moderate)));
}

/// Round an axis through the origin, of length 1: O. Rodrigues's formula.
inline model::Triple turned(const model::Triple& a, const model::Triple& axis, double angle) {
  const double cosine = std::cos(angle);
  return sum(sum(scaled(a, cosine), scaled(cross(axis, a), std::sin(angle))),
             scaled(axis, dot(axis, a) * (1 - cosine)));
}

}  // namespace raytracer::client

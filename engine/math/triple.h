// Three coordinates in a kernel's precision.
#pragma once

#include "engine/math/vec.h"

namespace raytracer {

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

}  // namespace raytracer

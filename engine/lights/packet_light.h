// A light as packets of points read it, in their own precision.
#pragma once

#include <cstddef>

#include "engine/lights/light_kind.h"
#include "engine/math/triple.h"

namespace raytracer {

template <typename T>
struct PacketLight {
  std::size_t kind;  ///< its place in LightKinds
  LightRays rays;
  Triple<T> place;     ///< parallel: unit, towards the light; else where it, or its centre, is
  Triple<T> emission;  ///< saturated, so that sums stay finite
  bool fades;          ///< with the distance's square
  std::size_t index;   ///< among the lights
  bool is_direction;   ///< one of those that rays to a soft light share
};

}  // namespace raytracer

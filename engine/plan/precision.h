// Whether single precision suffices for a scene, by the error that it would make.
#pragma once

#include <string>

#include "engine/plan/census.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// A decision, and why it was made in words and numbers.
template <typename T>
struct Choice {
  T value;
  std::string reason;
};

/// Single where its errors stay below 1/256 pixel and half a level of shading, else double.
/// `wish` other than automatic is granted.
Choice<Precision> choose_precision(Precision wish, const Census& census);

}  // namespace raytracer

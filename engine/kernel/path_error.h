// What a sample's path may make of rounding before it is traced again in double.
#pragma once

#include <memory>
#include <vector>

#include "engine/math/tolerances.h"
#include "engine/math/triple.h"

namespace raytracer {

/// What a step of a path rounds off, of the distances that it deals with. Derived. Measured: of the
/// 350,000 pixels of Haines' balls 106 then differ from double by more than a level, most of them
/// at edges; 44 with four times as much, 305 with a quarter, 4,464 if nothing is traced again.
template <typename T>
inline constexpr T path_rounding = unit_roundoff<T>;

/// A sample whose colour may be off by more is traced again. Derived: half a level of 255.
inline constexpr double most_colour_error = 0.5 / 255;

template <typename T>
struct PacketScene;

/// Shadows farther than `reach` from a point light are wider than a scene's precision carries.
struct LampReach {
  Triple<float> place;
  float reach2;  ///< squared
};

/// What traces the samples again whose paths magnify errors beyond what a scene's precision
/// carries.
struct ExactScene {
  std::shared_ptr<const PacketScene<double>> scene;  ///< none: nothing is traced again
  float brightest = 0;             ///< the most that lights make of a surface, any channel
  float nearest = 0;               ///< what rays from the eye meet nearer is traced again
  std::vector<LampReach> lamps{};  ///< and what any ray meets beyond their reach
};

}  // namespace raytracer

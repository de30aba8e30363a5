// What carries paths in double where a scene is otherwise in single precision.
#pragma once

#include <memory>
#include <vector>

#include "engine/math/triple.h"

namespace raytracer {

/// A sample whose colour may be off by more is traced again. Derived: half a level of 255.
inline constexpr double most_colour_error = 0.5 / 255;

template <typename T>
struct PacketScene;

/// Shadows farther than `reach` from a point light are wider than a scene's precision carries.
struct LampReach {
  Triple<float> place;
  float reach2;  ///< squared
};

/// The scene in double. Where mirrors or lenses magnify what is rounded, single finds what rays
/// meet, and double tells where and how they go on. What single cannot tell at all is traced again,
/// all of it in double.
struct ExactScene {
  std::shared_ptr<const PacketScene<double>> scene;  ///< none: single suffices
  bool carries_paths = false;                        ///< else samples are only traced again
  float nearest = 0;               ///< what rays from the eye meet nearer is traced again
  std::vector<LampReach> lamps{};  ///< and what any ray meets beyond their reach

  bool traces_again() const { return nearest > 0 || !lamps.empty(); }
};

}  // namespace raytracer

// The coordinates that kernels work in: the eye at the origin, the scene's extent near 1.
//
// Scaling is by a power of two, hence exact, and the eye is subtracted before any other
// arithmetic: a scene moved far away or scaled renders like the same scene at home, and squares
// neither overflow nor underflow.
#pragma once

#include "engine/math/vec.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct Frame {
  Vec3 eye;          ///< in scene coordinates
  int exponent = 0;  ///< one unit of the frame is 2^exponent of the scene's

  /// A point of the scene in frame coordinates; one rounding, of the difference to the eye.
  Vec3 frame_from_scene(const Vec3& point) const;

  /// A length of the scene in frame coordinates.
  double frame_from_scene(double length) const { return std::ldexp(length, -exponent); }
};

Frame make_frame(const Scene& scene);

}  // namespace raytracer

// The camera as the peers take it, from the document's formula and not from the engine's code.
#pragma once

#include "engine/engine.h"

namespace raytracer::peers {

/// The direction through image point (x, y) in pixels, y upwards from the lower edge, is that of
/// forward + right (2x/width - 1) + up (2y/height - 1).
struct EyeView {
  Vec3 forward;  ///< unit
  Vec3 right;
  Vec3 up;
};

/// The field of view must be in (0, pi).
EyeView make_eye_view(const Camera& camera);

}  // namespace raytracer::peers

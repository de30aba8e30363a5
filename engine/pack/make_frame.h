// The frame that suits a scene.
#pragma once

#include "engine/math/frame.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// The eye at the origin, the farthest thing about 1 away.
Frame make_frame(const Scene& scene);

}  // namespace raytracer

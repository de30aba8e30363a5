// The length that a peer's tolerances, which are absolute, have to be small against.
#pragma once

#include "engine/engine.h"

namespace raytracer::peers {

/// The least radius or length of any object, a hundredth of a mesh's extent; at most 1.
double smallest_feature(const Scene& scene);

}  // namespace raytracer::peers

// The spheres that a square stands for, for peers that have no such primitive.
#pragma once

#include "engine/engine.h"

namespace raytracer::peers {

/// 2n x 2n touching spheres, as a square places them.
Spheres expanded(const SphereSquare& square);

}  // namespace raytracer::peers

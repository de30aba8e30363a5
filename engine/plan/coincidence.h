// Surfaces that nearly coincide: which of them is seen is a matter of digits.
//
// Limits: spheres that are objects or members of a set, up to 10,000 of them, and the first 100
// planes. Triangles and the spheres of squares are not looked at.
#pragma once

#include "engine/plan/frame.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// The least gap between two surfaces all along each other, as a share of their distance from the
/// eye; infinite without such. Two that are the same to the bit have none: the document's order
/// decides between them.
double least_gap(const Scene& scene, const Frame& frame);

}  // namespace raytracer

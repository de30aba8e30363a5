// Surfaces that nearly coincide: which of them is seen is a matter of digits.
#pragma once

#include "engine/pack/packed_scene.h"

namespace raytracer {

/// The least gap between two surfaces all along each other, as a share of their distance from the
/// eye; infinite without such. Two that are the same to the bit have none: the document's order
/// decides between them.
///
/// Limits: kinds of which each primitive has a placement_of(), 10,000 primitives at most.
double least_gap(const PackedScene& packed);

}  // namespace raytracer

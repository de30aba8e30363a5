// How far apart places are, which is how large they can be drawn.
#pragma once

#include <cstddef>
#include <vector>

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// How far a place is from its nearest neighbour, as the median of some; 1 if there is none.
/// It is found by at most so many threads, at least one.
double typical_spacing(const std::vector<model::Triple>& places, std::size_t most_threads);

}  // namespace raytracer::client

// Where in a pixel its samples lie.
#pragma once

#include <vector>

#include "engine/kernel/sample_point.h"

namespace raytracer {

/// `count` places, spread evenly: every one of `count` columns and of `count` rows of the pixel
/// has one. A single sample is at the centre. The same for every pixel.
std::vector<SamplePoint> sample_pattern(int count);

}  // namespace raytracer

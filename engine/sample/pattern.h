// Where in a pixel its samples lie.
#pragma once

#include "engine/kernel/sample_point.h"

namespace raytracer {

/// `count` places, spread evenly: every one of `count` columns and of `count` rows of the pixel
/// has one. A single sample is at the centre. The same for every pixel. Multiples of four are in
/// two half buffers that are spread evenly, too, about the pixel's middle.
SamplePattern sample_pattern(int count);

/// The same, but neighbouring pixels have their samples elsewhere in the columns and rows.
SamplePattern jittered_pattern(int count);

}  // namespace raytracer

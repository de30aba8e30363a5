// The first picture under a budget: coarser than a sample per pixel where time is that short.
#pragma once

#include <optional>

#include "engine/render/coarse_picture.h"
#include "engine/render/tracing.h"

namespace raytracer {

/// The coarsest picture, and then all pixels of its blocks, block by block, until they are done or
/// the time is over. Nothing if it was stopped before there was a picture.
std::optional<CoarsePicture> trace_first_picture(Tracing& tracing);

}  // namespace raytracer

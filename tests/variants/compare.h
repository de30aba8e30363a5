// What pictures are compared with, and how.
#pragma once

#include "engine/image/image.h"
#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"

namespace raytracer::test {

/// The reference: one ray at a time, in double.
Image reference_image(const Scene& scene);

/// The picture of packets in this precision, on this instruction set.
Image image_on(const InstructionSet& set, Precision precision, Scene scene);

/// Pixels with a channel that is off by more than a level, or is no number.
int count_wrong(const Image& image, const Image& expected);

}  // namespace raytracer::test

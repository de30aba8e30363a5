// Scenes that the sampler was not made with: glints, subpixel spheres, mirrors, soups, meshes.
//
// Made from fixed seeds, the same text on every machine.
#pragma once

#include <vector>

#include "tests/measure/tradeoff/contracts.h"

namespace raytracer::published {

std::vector<ContractCase> untuned_scenes();

}  // namespace raytracer::published

// Scenes that the sampler was not made with: glints, subpixel spheres, mirrors, soups, meshes.
//
// Made from fixed seeds, the same text on every machine.
#pragma once

#include <vector>

#include "tests/measure/scenes/named_scene.h"

namespace raytracer::measure {

std::vector<NamedScene> untuned_scenes();

}  // namespace raytracer::measure

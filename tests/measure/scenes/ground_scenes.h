// Balls on a sphere so large that it looks flat, as the first scenes of many ray tracers have it:
// what is as near to the eye as it is wide stands on what is a thousand times as wide.
#pragma once

#include <string>

namespace raytracer::measure {

/// 487 balls, of matt, mirror and glass, under a sun.
std::string balls_on_ground_sphere();

/// The same, all of them matt, under a sky.
std::string balls_on_ground_sphere_under_sky();

}  // namespace raytracer::measure

// A scene as POV-Ray 3.7 takes it: SDL text.
//
// The camera and the shapes are exact. POV-Ray's ambient light does not depend on the lights, so
// it is left out and pictures are compared with ones without ambient light. Its highlights have
// the light's colour; on coloured materials `metallic` tints them, with a Fresnel term of its own
// that shows only where light grazes. Its tolerances are absolute (1e-3 for shadow rays), hence
// lengths are scaled until they are small against every sphere.
// Limits: distant lights; those of the Embree peer.
#pragma once

#include <ostream>

#include "engine/engine.h"

namespace raytracer::bench {

/// Throws std::runtime_error for a scene outside the limits above.
void write_povray_scene(const Scene& scene, std::ostream& out);

}  // namespace raytracer::bench

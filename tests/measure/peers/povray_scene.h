// A scene as POV-Ray 3.7 takes it: SDL text.
//
// The camera and the shapes are exact. POV-Ray's ambient light does not depend on the lights, which
// is what shadows "ambient" and "off" mean; with "black" it is left out. Its highlights have the
// light's colour; on coloured materials `metallic` tints them, with a Fresnel term of its own that
// shows only where light grazes. A surface that lets all through has a thousandth of its own
// opacity, because POV-Ray weakens the surface's own light by what is let through. Its tolerances
// are absolute (1e-3 for shadow rays), hence lengths are scaled until they are small against every
// sphere.
#pragma once

#include <ostream>

#include "engine/engine.h"

namespace raytracer::peers {

/// The scene must be one that the peer can draw.
void write_povray_scene(const Scene& scene, std::ostream& out);

}  // namespace raytracer::peers

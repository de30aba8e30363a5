// A scene as Tachyon 0.99 takes it: its own scene text.
//
// Coordinates are relative to the eye, because it reads them in single precision, and scaled,
// because its tolerances are absolute (1e-6). Its camera is ours: left-handed, seen through a
// frustum at distance 1, which is shifted by half a pixel because its rays go through a pixel's
// upper right corner. Ambient light does not depend on the lights, which is what shadows "ambient"
// and "off" mean; with "black" it is left out. A highlight has the light's colour (PLASTIC), exact
// on grey; on coloured materials it is METAL, of the material's colour whatever the light.
// Cylinders have no caps: rings close them.
#pragma once

#include <ostream>

#include "engine/engine.h"

namespace raytracer::peers {

/// The scene must be one that the peer can draw.
void write_tachyon_scene(const Scene& scene, std::ostream& out);

}  // namespace raytracer::peers

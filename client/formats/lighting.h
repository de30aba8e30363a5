// The light of a file's picture: its own, or that of a studio.
#pragma once

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// Adds a key light from the left above the eye, which the scene's view says, and a sky, which
/// gives depth.
void light_studio(model::Scene& scene);

/// Scales the lights of a file that counts in lumens and says no exposure, as one for a photograph:
/// what is looked at gets as much light as from a studio's key light. They keep their proportions.
void expose(model::Scene& scene);

}  // namespace raytracer::client

// What a file does not say of its picture: the camera, the lights and the background.
#pragma once

#include <optional>

#include "client/formats/scene_model.h"
#include "client/formats/wishes.h"

namespace raytracer::client {

/// Which way is up in a file.
enum class Upright {
  none,  ///< any way: molecules float
  y,     ///< as in most meshes
  z      ///< as in STL and boxes of particles
};

/// The camera that sees all of the scene's objects: from where the wishes say, else from where they
/// show most, which is the direction in which the box around them has the largest shadow. That box
/// lies along the axes, or along the objects' own ones (the principal axes) where it is smaller so
/// and nothing is upright.
model::View view_of_all(const model::Scene& scene, const Wishes& wishes, Upright upright);

/// Adds a key light from the left above the eye, which the scene's view says, and a sky, which
/// gives depth.
void light_studio(model::Scene& scene);

/// Sets the view, the lights, which are those of a studio, the background and how exact the picture
/// is to be. `view`: what the frames before had.
void arrange(model::Scene& scene, const Wishes& wishes, const model::View& view);

}  // namespace raytracer::client

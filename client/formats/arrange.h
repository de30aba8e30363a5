// What a file does not say of its picture: the camera, the lights and the background.
#pragma once

#include "client/formats/import_options.h"
#include "client/formats/scene_model.h"

namespace raytracer::client {

/// Which way is up in a file.
enum class Upright {
  none,  ///< any way: molecules float
  y,     ///< as in most meshes
  z      ///< as in STL and boxes of particles
};

/// The camera that sees all of the scene's objects: from where the options say, else from where
/// they show most, which is the direction in which the box around them has the largest shadow. That
/// box lies along the axes, or along the objects' own ones (the principal axes) where it is smaller
/// so and nothing is upright.
model::View view_of_all(const model::Scene& scene, const ImportOptions& options, Upright upright);

/// What the file's own camera sees: as high as it says, and as wide as the image is. It looks at
/// what is as far ahead as the middle of all.
model::View view_through(const model::Camera& camera, const model::Scene& scene,
                         const ImportOptions& options);

/// Whether the scene's own view shows the middle of everything, of meshes the vertices.
bool is_all_in_view(const model::Scene& scene);

/// Sets the view, the lights, which are those of a studio if the file has none, the background and
/// how exact the picture is to be. `view`: what the frames before had.
void arrange(model::Scene& scene, const ImportOptions& options, const model::View& view);

}  // namespace raytracer::client

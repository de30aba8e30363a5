// What the server found wrong with a scene, as lines that a person and an editor can follow.
#pragma once

#include "client/api.h"
#include "client/arguments.h"
#include "client/failure.h"
#include "client/scene_source.h"

namespace raytracer::client {

/// One line for each error: "FILE:LINE:COLUMN: /objects/3/radius: detail", or, for a value that
/// an option put over the scene's, "--width: /camera/width: detail".
InputError explain(const Refused& refused, const SceneSource& scene, const Overrides& overrides);

}  // namespace raytracer::client

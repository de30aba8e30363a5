// What the server found wrong with a scene, as lines that a person and an editor can follow.
#pragma once

#include <string>

#include "client/scene_text.h"

namespace raytracer::client {

/// A problem document (RFC 9457) with one line for each of its errors:
/// "FILE:LINE: /objects/3/radius: detail", or, for a value that an option put over the scene's,
/// "--width: /camera/width: detail". Without errors its `detail`, after the scene's label.
std::string explain(const std::string& problem, const SceneText& scene, const Overrides& overrides);

}  // namespace raytracer::client

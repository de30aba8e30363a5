// The bracket around everything that needs a server: signals, a private daemon if no server is
// named, and the connection to it, all gone again when it closes.
#pragma once

#include <functional>
#include <string>

#include "client/api.h"
#include "client/scene_text.h"
#include "client/server_choice.h"

namespace raytracer::client {

/// Calls `use` with the chosen server, or the one that the variables name. Throws what `use` does;
/// if the private daemon has ended meanwhile, a ServerError that says how.
void with_server(const ServerChoice& given, const std::function<void(Api&)>& use);

/// The same with the scene that is chosen: a file, which is read first, "-", or a shipped one. The
/// overrides say the size of its image. Returns the scene.
SceneText with_scene(const SceneChoice& scene, const Overrides& overrides,
                     const ServerChoice& given,
                     const std::function<void(Api&, const SceneText&)>& use);

}  // namespace raytracer::client

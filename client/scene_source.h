// Where the text of a scene comes from: a file, standard input, or the server's own shelf.
#pragma once

#include <optional>
#include <string>

#include "client/api.h"

namespace raytracer::client {

struct SceneSource {
  std::string label;  ///< for messages: the path, "standard input" or the name
  std::string text;
  bool editable = true;  ///< the person who asks has its text: lines and columns mean something
};

/// The scene if `scene` is "-" or names a file; none if it may be a shipped scene's name.
/// Throws InputError for what cannot be read, and for a path that is not there.
std::optional<SceneSource> read_scene_file(const std::string& scene);

/// The shipped scene of this name. Throws InputError that lists the names if there is none.
SceneSource fetch_shipped_scene(const std::string& name, Api& api);

}  // namespace raytracer::client

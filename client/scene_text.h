// A scene as it is sent, and where its text comes from: a file, of a scene document or of another
// format, standard input, or the server's own shelf.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace raytracer::client {

struct SceneText {
  std::string label;  ///< for messages: the path, "standard input" or the name
  std::string text;
  bool editable = true;  ///< the person who asks has its text: lines mean something
};

/// The server's query parameters by name; they stand over the scene's own values.
using Overrides = std::map<std::string, std::string>;

/// The scene if `scene` is "-" or names a file; none if it may be a shipped scene's name. A file
/// whose ending is that of another format becomes a scene document; what that cannot say is said on
/// standard error. Throws InputError for what cannot be read, and for a path that is not there.
std::optional<SceneText> read_scene_file(const std::string& scene);

}  // namespace raytracer::client

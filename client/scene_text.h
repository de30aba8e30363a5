// A scene as it is sent, and where its text comes from: a file, of a scene document or of another
// format, standard input, or the server's own shelf.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "client/formats/import_options.h"
#include "client/formats/scene_file.h"

namespace raytracer::client {

struct SceneText {
  std::string label;  ///< for messages: the path, "standard input" or the name
  std::string text;
  bool editable = true;  ///< the person who asks has its text: lines mean something
};

/// The server's query parameters by name; they stand over the scene's own values.
using Overrides = std::map<std::string, std::string>;

/// What stands in SCENE's place on the command line, and the flags about what it may leave open.
struct SceneChoice {
  std::string name;  ///< a file, "-", or a shipped scene's name
  ImportOptions import_options;
  std::vector<std::string> flags_given;  ///< of those about import, "--style"
};

/// The scene if the choice is "-" or a file; none if it may be a shipped scene's name. A file whose
/// ending is that of another format becomes a scene document: its first frame; what that cannot say
/// is said on standard error. Throws InputError for what cannot be read, for a path that is not
/// there, and for flags about what the scene does not leave open. Of the overrides the size of the
/// image counts.
std::optional<SceneText> read_scene_file(const SceneChoice& choice,
                                         const Overrides& overrides = {});

/// Whether the choice is a file of a format that has frames, if only one.
bool has_frames(const SceneChoice& choice);

/// Frame for frame what a file of another format means; the next one is read while it is called.
/// Returns nothing behind the last one. Throws as above.
using NextFrame = std::function<std::optional<SceneText>()>;

/// Throws InputError if the choice has no frames.
NextFrame read_frames(const SceneChoice& choice, const Overrides& overrides);

}  // namespace raytracer::client

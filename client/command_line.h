// What commands have in common on the command line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/output_file.h"
#include "client/scene_text.h"
#include "client/server_choice.h"

namespace CLI {
class App;
}

namespace raytracer::client {

/// The options that say which server, of every command; with_variables() adds what they leave open.
void add_server_options(CLI::App& app, ServerChoice& server);

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& purpose);

/// A command that is about a scene: a file, "-", or a shipped scene's name. With the options about
/// what a file may leave open.
CLI::App& add_scene_command(CLI::App& app, const std::string& name, const std::string& purpose,
                            SceneChoice& scene);

/// These options alone.
void add_import_flags(CLI::App& command, SceneChoice& scene);

/// For CLI11, which asks for words about what is wrong with a value, or none: a number that is
/// finite and greater than 0.
std::string refuse_unless_positive(const std::string& text);

using RefuseValue = std::function<std::string(const std::string&)>;
/// Likewise: a whole number from `least` to `most`.
RefuseValue refuse_unless_whole(int least, int most);
/// Likewise: one of these.
RefuseValue refuse_unless_among(std::vector<std::string> words);

/// Options that say how accurate a picture is to be.
void add_accuracy_options(CLI::App& command, Overrides& overrides);

/// Options that say which picture.
void add_picture_options(CLI::App& command, Overrides& overrides);

/// -o, with a file whose ending is one of `endings`.
void add_output_option(CLI::App& command, std::optional<OutputFile>& output,
                       const std::string& help, const std::vector<std::string>& endings);

}  // namespace raytracer::client

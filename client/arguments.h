// The command line and its variables, checked before anything is done: see raytracer --help.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "client/server_url.h"

namespace CLI {
class App;
}

namespace raytracer::client {

/// The server's query parameters by name; they stand over the scene's own values.
using Overrides = std::map<std::string, std::string>;

struct RenderArguments {
  std::string scene;                            ///< a file, "-", or a shipped scene's name
  std::optional<std::filesystem::path> output;  ///< none: the terminal, or standard output
  Overrides overrides;
  bool watch = false;  ///< again whenever the file changes
};

struct ValidateArguments {
  std::string scene;
};

struct PlanArguments {
  std::string scene;
  bool as_json = false;  ///< the server's own answer
  Overrides overrides;
};

struct TradeoffArguments {
  std::string scene;
  std::optional<std::filesystem::path> output;  ///< none: as text on standard output
  Overrides overrides;
};

struct ScenesArguments {};

/// Which daemon to talk to.
struct ServerChoice {
  std::optional<ServerUrl> url;  ///< none: a private one
  std::string token;             ///< empty: none
};

struct Arguments {
  ServerChoice server;
  std::variant<RenderArguments, PlanArguments, TradeoffArguments, ValidateArguments,
               ScenesArguments>
      command;
};

/// A text that was asked for, to be printed instead of doing anything.
struct HelpText {
  std::string text;
};

/// Reads argv and the variables RAYTRACER_SERVER and RAYTRACER_TOKEN.
/// Throws InputError for everything that could not be meant.
std::variant<Arguments, HelpText> read_arguments(int argc, const char* const* argv);

/// Gives the table of commands and options that --help prints, for the manual and the completions.
void show_command_line(const std::function<void(const CLI::App&)>& look);

}  // namespace raytracer::client

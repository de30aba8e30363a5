// The commands, one source file each, COMMAND_command.cpp.
#pragma once

#include <array>

#include "client/server_choice.h"

namespace CLI {
class App;
}

namespace raytracer::client {

/// Adds a command to the command line: its options, and what it does when it is given, which throws
/// InputError, ServerError or Interrupted.
using AddCommand = void(CLI::App& app, const ServerChoice& server);

AddCommand add_render;
AddCommand add_plan;
AddCommand add_tradeoff;
AddCommand add_validate;
AddCommand add_animate;
AddCommand add_open;
AddCommand add_convert;
AddCommand add_scenes;
AddCommand add_cluster;

/// In the order of --help.
inline constexpr std::array all_commands{add_render,   add_plan,    add_tradeoff,
                                         add_validate, add_animate, add_open,
                                         add_convert,  add_scenes,  add_cluster};

}  // namespace raytracer::client

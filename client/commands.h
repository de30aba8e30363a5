// The commands, one source file each: it adds the command to the command line, with its options and
// what it does, which throws InputError, ServerError or Interrupted. main.cpp lists them.
#pragma once

#include "client/server_choice.h"

namespace CLI {
class App;
}

namespace raytracer::client {

void add_render(CLI::App& app, const ServerChoice& server);
void add_plan(CLI::App& app, const ServerChoice& server);
void add_tradeoff(CLI::App& app, const ServerChoice& server);
void add_validate(CLI::App& app, const ServerChoice& server);
void add_scenes(CLI::App& app, const ServerChoice& server);

}  // namespace raytracer::client

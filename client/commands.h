// The commands, one source file each. Every one throws InputError, ServerError or Interrupted.
#pragma once

#include "client/arguments.h"

namespace raytracer::client {

/// Renders and delivers the image; one line about it on standard error.
void render(const RenderArguments& arguments, const ServerChoice& server);

/// Prints what the server would do with the scene, each choice with its reason.
void plan(const PlanArguments& arguments, const ServerChoice& server);

/// Measures what accuracy costs on the scene; writes the curve, or prints it.
void tradeoff(const TradeoffArguments& arguments, const ServerChoice& server);

/// Prints "SCENE: valid", or throws with every error.
void validate(const ValidateArguments& arguments, const ServerChoice& server);

/// Prints the shipped scenes, each with its description.
void list_scenes(const ServerChoice& server);

}  // namespace raytracer::client

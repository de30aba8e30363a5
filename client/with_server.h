// The bracket around everything that needs a server: signals, a private daemon if no server is
// named, and the connection to it, all gone again when it closes.
#pragma once

#include <functional>

#include "client/api.h"
#include "client/arguments.h"

namespace raytracer::client {

/// Calls `use` with the chosen server. Throws what `use` does; if the private daemon has
/// ended meanwhile, a ServerError that says how.
void with_server(const ServerChoice& choice, const std::function<void(Api&)>& use);

}  // namespace raytracer::client

// The variables of the shell.
#pragma once

#include <cstdlib>
#include <string>

namespace raytracer::client {

/// Empty if it is not set.
inline std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

}  // namespace raytracer::client

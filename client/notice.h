// What is said beside a command's result.
#pragma once

#include <string_view>

namespace raytracer::client {

/// Writes a line to standard error. Where that is closed or full nobody is there to tell, and the
/// command goes on.
void notice(std::string_view line);

}  // namespace raytracer::client

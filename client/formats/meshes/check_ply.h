// What is wrong with a PLY, line by line, and what a scene cannot say of it: assimp takes a file
// that was cut off for a whole one, and makes up what is missing.
#pragma once

#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Adds errors and omissions to the reading. What it does not know it accepts. Throws InputError
/// for what has no line.
void check_ply(std::string_view bytes, Reading& reading);

}  // namespace raytracer::client

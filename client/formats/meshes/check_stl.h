// What is wrong with an STL, line by line: assimp takes what was cut off for whole, and does not
// say where a word is none of its own.
#pragma once

#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Adds errors and omissions to the reading. What it does not know it accepts. Throws InputError
/// for what has no line.
void check_stl(std::string_view bytes, Reading& reading);

}  // namespace raytracer::client

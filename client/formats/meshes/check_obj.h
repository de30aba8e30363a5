// What is wrong with an OBJ, line by line, and what a scene cannot say of it: assimp passes over
// the one without a line and over the other without a word.
#pragma once

#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Adds errors and omissions to the reading. What it does not know it accepts.
void check_obj(std::string_view text, Reading& reading);

}  // namespace raytracer::client

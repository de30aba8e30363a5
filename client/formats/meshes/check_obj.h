// What is wrong with an OBJ, line by line, and what a scene cannot say of it: assimp passes over
// the one without a line and over the other without a word.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

/// The bytes of a file of that name beside one that is read; none if it cannot be read.
using FileBeside = std::function<std::optional<std::string>(std::string_view name)>;

/// Adds errors and omissions to the reading, also those of its files of materials. What it does not
/// know it accepts.
void check_obj(std::string_view text, const FileBeside& beside, Reading& reading);

}  // namespace raytracer::client

// A PLY in bytes, as assimp reads it rightly.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raytracer::client {

/// Where the bytes behind the header begin with 0x0A, assimp takes that for the end of the header's
/// last line. Ended by two characters, the line is over before. Nothing: the PLY is well as it is.
std::optional<std::string> ply_as_assimp_knows_it(std::string_view ply);

}  // namespace raytracer::client

// A PLY as assimp reads it rightly.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raytracer::client {

/// Where the bytes behind the header begin with 0x0A, assimp takes that for the end of the header's
/// last line. Ended by two characters, the line is over before. It does not know colours of
/// vertices by the name of diffuse_red, and takes a white of type int for the half of what an int
/// can hold: in text they become uchar, in bytes they are not shown to it. Nothing: the PLY is well
/// as it is.
std::optional<std::string> ply_as_assimp_knows_it(std::string_view ply);

}  // namespace raytracer::client

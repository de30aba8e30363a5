// Numbers of Wavefront's OBJ as assimp knows them: to its count of a vertex's coordinates ".5" is
// none, so that the vertex is lost.
#pragma once

#include <string>
#include <string_view>

namespace raytracer::client {

/// The file's text with a zero before each number of a vertex that begins with its point.
std::string with_zeros_before_points(std::string_view obj);

}  // namespace raytracer::client

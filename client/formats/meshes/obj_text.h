// The text of an OBJ as assimp knows it. To its count of a vertex's coordinates ".5" is none, so
// that the vertex is lost; it does not see what is indented, takes "foo 1 2 3" for a face, joins to
// a comment the line behind it, and refuses places of textures that have one number. Where some
// vertices have colours it gives them to the first ones: the others are written as white.
#pragma once

#include <string>
#include <string_view>

namespace raytracer::client {

/// The statements of shapes, names and materials, each on a line of its own, without the others.
std::string obj_as_assimp_knows_it(std::string_view obj);

}  // namespace raytracer::client

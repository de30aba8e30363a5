// Vertices that several triangles have in common.
#pragma once

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// Vertices that are the same to the last bit become one: assimp's readers give each triangle its
/// own, and assimp joins what is merely near, which small models do not survive.
void join_vertices(model::Mesh& mesh);

}  // namespace raytracer::client

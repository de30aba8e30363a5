// Meshes as assimp reads them, with what a scene can say of them. The one place with assimp, in a
// library of its own that is loaded when there is a mesh to read: assimp and what it needs take as
// long to load as the rest of the program.
#pragma once

#include <string>
#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

enum class MeshFormat { ply, obj, stl, gltf, glb };

/// Adds the objects and materials of a file to the reading, without a view or lights. `bytes`: what
/// it has, unpacked if it is compressed. `path`: beside it lie the files that it names; empty:
/// there are none. Throws InputError.
using ImportMeshes = void(MeshFormat format, const std::string& path, std::string_view bytes,
                          Reading& reading);

extern "C" ImportMeshes raytracer_import_meshes;

}  // namespace raytracer::client

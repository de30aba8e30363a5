// Meshes as assimp reads them, with what a scene can say of them. The one place with assimp, in a
// library of its own that is loaded when there is a mesh to read: assimp and what it needs take as
// long to load as the rest of the program.
#pragma once

#include <string>
#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

enum class MeshFormat { ply, obj, stl, gltf, glb };

/// The objects and materials of a file, without a view or lights. `text`: its bytes, if the file at
/// `path` is compressed; else empty, and files that it names are read beside it. Throws InputError.
using ImportMeshes = void(MeshFormat format, const std::string& path, std::string_view text,
                          Reading& reading);

extern "C" ImportMeshes raytracer_import_meshes;

}  // namespace raytracer::client

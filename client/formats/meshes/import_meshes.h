// Meshes as assimp reads them, with what a scene can say of them. The one place with assimp.
#pragma once

#include <string>
#include <string_view>

#include "client/formats/reading.h"

namespace raytracer::client {

enum class MeshFormat { ply, obj, stl, gltf, glb };

/// The objects and materials of a file, without a view or lights. `text`: its bytes, if the file at
/// `path` is compressed; else empty, and files that it names are read beside it. Throws InputError.
Reading import_meshes(MeshFormat format, const std::string& path, std::string_view text);

}  // namespace raytracer::client

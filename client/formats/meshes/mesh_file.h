// The formats of meshes: for each the file that `format.h` names.
#pragma once

#include <memory>

#include "client/formats/scene_file.h"

namespace raytracer::client {

/// Stanford's PLY.
std::unique_ptr<SceneFile> open_ply(FileInput input, const ImportOptions& options);
/// Wavefront's OBJ, and the materials that lie beside it.
std::unique_ptr<SceneFile> open_obj(FileInput input, const ImportOptions& options);
/// Triangles of stereolithography.
std::unique_ptr<SceneFile> open_stl(FileInput input, const ImportOptions& options);
/// glTF 2.0 as JSON, and the buffers that lie beside it.
std::unique_ptr<SceneFile> open_gltf(FileInput input, const ImportOptions& options);
/// glTF 2.0 in one binary file.
std::unique_ptr<SceneFile> open_glb(FileInput input, const ImportOptions& options);

}  // namespace raytracer::client

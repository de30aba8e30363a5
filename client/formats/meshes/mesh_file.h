// The formats of meshes: for each the file that `format.h` names.
#pragma once

#include <memory>

#include "client/formats/scene_file.h"

namespace raytracer::client {

std::unique_ptr<SceneFile> open_ply(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_obj(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_stl(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_gltf(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_glb(FileInput input, const Wishes& wishes);

}  // namespace raytracer::client

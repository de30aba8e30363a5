// A file's material as a scene has them.
#pragma once

#include <assimp/material.h>

#include "client/formats/meshes/import_meshes.h"

namespace raytracer::client {

bool is_gltf(MeshFormat format);

/// In [0, 1]: glTF counts light, the others what screens show.
model::Rgb light(MeshFormat format, const aiColor4D& color);

/// Of what has none.
model::Material plain_material();

struct MeshMaterial {
  model::Material material;
  bool is_seen;  ///< a mask may leave nothing
};

MeshMaterial material_of(MeshFormat format, const aiMaterial& file);

/// Tells what of a material that something has is not shown.
void tell_of(MeshFormat format, const aiMaterial& file, Reading& reading);

}  // namespace raytracer::client

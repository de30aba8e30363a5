#include "client/formats/meshes/mesh_material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>

#include <algorithm>

#include "client/formats/numbers.h"
#include "client/formats/screen_color.h"

namespace raytracer::client {
namespace {

/// Beyond germanium's there is none that is worth a picture; nothing below 1 is sent.
void set_ior(float index, model::Material& material) {
  constexpr float most = 4;
  if (index >= 1) material.ior = static_cast<double>(std::min(index, most));
}

/// An OBJ's dissolve lets light through, which its illumination models 6 and 7 bend by Ni.
void set_refraction(const aiMaterial& file, model::Material& material) {
  int illumination = 0;
  float index = 1;
  if (material.transparency > 0 &&
      file.Get(AI_MATKEY_OBJ_ILLUM, illumination) == aiReturn_SUCCESS &&
      (illumination == 6 || illumination == 7) &&
      file.Get(AI_MATKEY_REFRACTI, index) == aiReturn_SUCCESS)
    set_ior(index, material);
}

/// What lets light through (KHR_materials_transmission) is thin, and bends nothing, unless it has
/// a volume (KHR_materials_volume, KHR_materials_ior).
void set_transmission(const aiMaterial& file, double opacity, model::Material& material) {
  float transmission = 0;
  if (file.Get(AI_MATKEY_TRANSMISSION_FACTOR, transmission) != aiReturn_SUCCESS ||
      !(transmission > 0))
    return;
  material.transparency = 1 - opacity * (1 - static_cast<double>(std::min(transmission, 1.0F)));
  float thickness = 0;
  if (file.Get(AI_MATKEY_VOLUME_THICKNESS_FACTOR, thickness) != aiReturn_SUCCESS ||
      !(thickness > 0))
    return;
  float index = 1.5F;
  file.Get(AI_MATKEY_REFRACTI, index);
  set_ior(index, material);
}

/// In [0, 1]. A glTF's material says whether its colour's alpha counts (section 3.9.4).
double opacity_of(MeshFormat format, const aiMaterial& file) {
  float opacity = 1;
  if (file.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS || !(opacity >= 0)) return 1;
  aiString mode;
  if (is_gltf(format) && file.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS) {
    float cutoff = 0.5F;
    file.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff);
    if (mode == aiString("MASK")) return opacity < cutoff ? 0 : 1;
    if (mode == aiString("OPAQUE")) return 1;
  }
  return static_cast<double>(std::min(opacity, 1.0F));
}

/// OBJ's Ks and Ns are those of Blinn and Phong; of what it does not say assimp says 0.
void set_highlight(MeshFormat format, const aiMaterial& file, model::Material& material) {
  aiColor4D color;
  if (format != MeshFormat::obj || file.Get(AI_MATKEY_COLOR_SPECULAR, color) != aiReturn_SUCCESS)
    return;
  const float strength = (color.r + color.g + color.b) / 3;
  if (strength > 0) material.ks = static_cast<double>(std::min(strength, 1.0F));
  float exponent = 0;
  if (file.Get(AI_MATKEY_SHININESS, exponent) == aiReturn_SUCCESS && exponent > 0 &&
      is_moderate(static_cast<double>(exponent)))
    material.shininess = static_cast<double>(exponent);
}

}  // namespace

bool is_gltf(MeshFormat format) { return format == MeshFormat::gltf || format == MeshFormat::glb; }

model::Rgb light(MeshFormat format, const aiColor4D& color) {
  const auto share = [](float value) { return value >= 0 ? std::min(value, 1.0F) : 0; };
  const model::Rgb rgb{share(color.r), share(color.g), share(color.b)};
  return is_gltf(format) ? rgb : linear(rgb);
}

model::Material plain_material() {
  model::Material material{};
  material.color = {0.6, 0.6, 0.6};
  material.kd = 0.7;
  material.ks = 0.25;
  material.shininess = 30;
  material.ior = 1;
  return material;
}

MeshMaterial material_of(MeshFormat format, const aiMaterial& file) {
  model::Material material = plain_material();
  aiColor4D color;
  // STL has none: assimp says white, which would leave no outline before a white background.
  const bool has_color =
      format != MeshFormat::stl && (file.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
                                    file.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS);
  if (has_color) {
    const model::Rgb rgb = light(format, color);
    material.color = {rgb[0], rgb[1], rgb[2]};
  }
  const double opacity = opacity_of(format, file);
  material.transparency = 1 - opacity;
  if (format == MeshFormat::obj) set_refraction(file, material);
  if (is_gltf(format)) set_transmission(file, opacity, material);
  set_highlight(format, file, material);
  return {material, opacity > 0};
}

void tell_of(MeshFormat format, const aiMaterial& file, Reading& reading) {
  aiColor4D color;
  float metal = 0;
  if (file.Get(AI_MATKEY_METALLIC_FACTOR, metal) == aiReturn_SUCCESS && metal > 0)
    reading.omit(0, "metal shown as if it were painted", "metals shown as if they were painted");
  if (file.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS &&
      color.r + color.g + color.b > 0)
    reading.omit(0, "material that glows shown without that",
                 "materials that glow shown without that");
  for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type) {
    // Of glTF assimp has it among the diffuse ones, too.
    if (type == aiTextureType_BASE_COLOR && is_gltf(format)) continue;
    for (unsigned i = 0; i < file.GetTextureCount(static_cast<aiTextureType>(type)); ++i)
      reading.omit(0, "texture left out", "textures left out");
  }
}

}  // namespace raytracer::client

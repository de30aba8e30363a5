#include "client/formats/meshes/import_meshes.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/GltfMaterial.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "client/failure.h"
#include "client/formats/meshes/join_vertices.h"
#include "client/formats/meshes/obj_text.h"
#include "client/formats/meshes/ply_as_assimp_knows_it.h"
#include "client/formats/particles/columns.h"
#include "client/formats/particles/neighbors.h"
#include "client/formats/particles/screen_color.h"
#include "client/formats/printable.h"
#include "client/formats/text_source.h"

namespace raytracer::client {
namespace {

constexpr std::array<const char*, 5> endings{"ply", "obj", "stl", "gltf", "glb"};

/// Of a URI, as RFC 3986 writes its octets (section 2.1).
std::string without_percents(std::string_view uri) {
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char octet = 0;
    const char* const digits = uri.data() + i + 1;
    const bool is_octet = uri[i] == '%' && i + 2 < uri.size() &&
                          std::from_chars(digits, digits + 2, octet, 16).ptr == digits + 2 &&
                          octet != 0;
    plain += is_octet ? static_cast<char>(octet) : uri[i];
    if (is_octet) i += 2;
  }
  return plain;
}

/// The file that is read, which is in memory, and those beside it that it names.
class MeshFiles : public Assimp::DefaultIOSystem {
 public:
  /// `missing` outlives this: it counts the files that cannot be opened.
  MeshFiles(std::string name, std::string_view bytes, bool has_folder, unsigned& missing)
      : name_(std::move(name)), bytes_(bytes), has_folder_(has_folder), missing_(missing) {}

  bool Exists(const char* path) const override {
    return path == name_ || (has_folder_ && DefaultIOSystem::Exists(path));
  }

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (path == name_)
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()),
                                        bytes_.size());
    Assimp::IOStream* file = has_folder_ ? DefaultIOSystem::Open(path, mode) : nullptr;
    if (!file && has_folder_) file = DefaultIOSystem::Open(beside(path).c_str(), mode);
    if (!file) ++missing_;
    return file;
  }

 private:
  /// What a URI of glTF, in which a blank is %20, means beside the file.
  std::string beside(std::string_view path) const {
    const std::size_t folder = name_.rfind('/') + 1;
    if (!name_.ends_with(".gltf") || !path.starts_with(std::string_view(name_).substr(0, folder)))
      return std::string(path);
    return std::string(path.substr(0, folder)) + without_percents(path.substr(folder));
  }

  std::string name_;
  std::string_view bytes_;
  bool has_folder_;
  unsigned& missing_;
};

model::Triple triple(const aiVector3D& vector) {
  return {static_cast<double>(vector.x), static_cast<double>(vector.y),
          static_cast<double>(vector.z)};
}

bool is_place(const aiVector3D& vector) {
  const model::Triple place = triple(vector);
  return std::all_of(place.begin(), place.end(), is_moderate);
}

class MeshImport {
 public:
  /// Adds to the reading.
  MeshImport(MeshFormat format, const aiScene& scene, Reading& reading)
      : format_(format), scene_(scene), reading_(reading) {}

  /// Before what is no scene's is taken out of it.
  void count_omissions(bool lacks_materials) {
    omit(lacks_materials ? 1 : 0, "file of materials not found: its objects are gray",
         "files of materials not found: their objects are gray");
    omit(scene_.mNumTextures, "image left out", "images left out");
    omit(scene_.mNumAnimations, "animation left out", "animations left out");
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      omit(scene_.mMeshes[i]->mNumBones, "bone left out", "bones left out");
      omit(scene_.mMeshes[i]->mNumAnimMeshes, "shape that a mesh may take left out",
           "shapes that meshes may take left out");
    }
  }

  /// Points have no places in a hierarchy.
  bool has_faces() const {
    return std::any_of(scene_.mMeshes, scene_.mMeshes + scene_.mNumMeshes,
                       [](const aiMesh* mesh) { return mesh->HasFaces(); });
  }

  void read() {
    std::vector<bool> is_used(scene_.mNumMaterials);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      if (const unsigned used = scene_.mMeshes[i]->mMaterialIndex; used < is_used.size())
        is_used[used] = true;
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      add_material(*scene_.mMaterials[i]);
      if (is_used[i]) tell_of(*scene_.mMaterials[i]);
    }
    if (scene_.mNumMaterials == 0) reading_.scene.materials.push_back(plain());
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) add(*scene_.mMeshes[i]);
    const std::string rounding = rounding_of_places();
    if (reading_.scene.objects.empty())
      throw InputError(
          (has_flat_ ? "has no triangles with an area" : "has no triangles and no points") +
          (rounding.empty() ? "" : ": it is a " + rounding));
    if (!rounding.empty()) reading_.omit(0, rounding, "");
  }

 private:
  /// By the format's check, which knows where they are.
  bool are_lines_told() const { return format_ == MeshFormat::obj || format_ == MeshFormat::ply; }

  void omit(unsigned count, std::string_view one, std::string_view many) {
    for (; count > 0; --count) reading_.omit(0, one, many);
  }

  static model::Material plain() {
    model::Material material{};
    material.color = {0.6, 0.6, 0.6};
    material.kd = 0.7;
    material.ks = 0.25;
    material.shininess = 30;
    material.ior = 1;
    return material;
  }

  bool is_gltf() const { return format_ == MeshFormat::gltf || format_ == MeshFormat::glb; }

  /// Assimp keeps places in single precision, which is coarse far from the origin. Empty if that is
  /// not seen.
  std::string rounding_of_places() const {
    constexpr float visible = 2e-4F;  // of the size of all
    float largest = 0;
    aiVector3D low(std::numeric_limits<float>::max());
    aiVector3D high(std::numeric_limits<float>::lowest());
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      for (unsigned k = 0; k < scene_.mMeshes[i]->mNumVertices; ++k) {
        const aiVector3D& place = scene_.mMeshes[i]->mVertices[k];
        if (!is_place(place)) continue;
        for (unsigned axis = 0; axis < 3; ++axis) {
          largest = std::max(largest, std::abs(place[axis]));
          low[axis] = std::min(low[axis], place[axis]);
          high[axis] = std::max(high[axis], place[axis]);
        }
      }
    const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const float step = largest * std::numeric_limits<float>::epsilon();
    if (!(size >= 0 && step > visible * size) || (size == 0 && !has_flat_)) return "";
    return fmt::format(
        "file far from the origin, whose places are kept in single precision: steps of {:.2g}",
        step);
  }

  /// glTF counts light, the others what screens show.
  model::Rgb light(const aiColor4D& color) const {
    const auto share = [](float value) { return value >= 0 ? std::min(value, 1.0F) : 0; };
    const model::Rgb rgb{share(color.r), share(color.g), share(color.b)};
    return is_gltf() ? rgb : linear(rgb);
  }

  void add_material(const aiMaterial& file) {
    model::Material material = plain();
    aiColor4D color;
    // STL has none: assimp says white, which would leave no outline before a white background.
    const bool has_color = format_ != MeshFormat::stl &&
                           (file.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
                            file.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS);
    if (has_color) {
      const model::Rgb rgb = light(color);
      material.color = {rgb[0], rgb[1], rgb[2]};
    }
    const double opacity = opacity_of(file);
    material.transparency = 1 - opacity;
    if (is_gltf()) set_transmission(file, opacity, material);
    set_highlight(file, material);
    reading_.scene.materials.push_back(material);
    is_seen_.push_back(opacity > 0);
  }

  /// What lets light through (KHR_materials_transmission) is thin, and bends nothing, unless it has
  /// a volume (KHR_materials_volume, KHR_materials_ior).
  static void set_transmission(const aiMaterial& file, double opacity, model::Material& material) {
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
    constexpr float most = 4;  // germanium's
    if (index >= 1) material.ior = static_cast<double>(std::min(index, most));
  }

  /// In [0, 1]. A glTF's material says whether its colour's alpha counts (section 3.9.4).
  double opacity_of(const aiMaterial& file) const {
    float opacity = 1;
    if (file.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS || !(opacity >= 0)) return 1;
    aiString mode;
    if (is_gltf() && file.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS) {
      float cutoff = 0.5F;
      file.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff);
      if (mode == aiString("MASK")) return opacity < cutoff ? 0 : 1;
      if (mode == aiString("OPAQUE")) return 1;
    }
    return static_cast<double>(std::min(opacity, 1.0F));
  }

  /// What of a material that something has is not shown.
  void tell_of(const aiMaterial& file) {
    aiColor4D color;
    float metal = 0;
    if (file.Get(AI_MATKEY_METALLIC_FACTOR, metal) == aiReturn_SUCCESS && metal > 0)
      omit(1, "metal shown as if it were painted", "metals shown as if they were painted");
    if (file.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS &&
        color.r + color.g + color.b > 0)
      omit(1, "material that glows shown without that", "materials that glow shown without that");
    for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type) {
      // Of glTF assimp has it among the diffuse ones, too.
      if (type == aiTextureType_BASE_COLOR && is_gltf()) continue;
      omit(file.GetTextureCount(static_cast<aiTextureType>(type)), "texture left out",
           "textures left out");
    }
  }

  /// OBJ's Ks and Ns are those of Blinn and Phong; of what it does not say assimp says 0.
  void set_highlight(const aiMaterial& file, model::Material& material) const {
    aiColor4D color;
    if (format_ != MeshFormat::obj || file.Get(AI_MATKEY_COLOR_SPECULAR, color) != aiReturn_SUCCESS)
      return;
    const float strength = (color.r + color.g + color.b) / 3;
    if (strength > 0) material.ks = static_cast<double>(std::min(strength, 1.0F));
    float exponent = 0;
    if (file.Get(AI_MATKEY_SHININESS, exponent) == aiReturn_SUCCESS && exponent > 0 &&
        is_moderate(static_cast<double>(exponent)))
      material.shininess = static_cast<double>(exponent);
  }

  void add(const aiMesh& mesh) {
    const std::size_t material =
        std::min<std::size_t>(mesh.mMaterialIndex, reading_.scene.materials.size() - 1);
    if (material < is_seen_.size() && !is_seen_[material])
      return omit(1, "mesh of which nothing is to be seen left out",
                  "meshes of which nothing is to be seen left out");
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0)
      add_triangles(mesh, material);
    else if ((mesh.mPrimitiveTypes & aiPrimitiveType_LINE) != 0)
      omit(are_lines_told() ? 0 : mesh.mNumFaces, "line left out", "lines left out");
    else
      add_points(mesh, material);
  }

  /// A glTF's are multiplied with its material's (section 3.9.2), others stand in its place.
  model::Rgb vertex_color(const aiMesh& mesh, unsigned vertex, std::size_t material) const {
    model::Rgb color = light(mesh.mColors[0][vertex]);
    if (is_gltf())
      for (std::size_t i = 0; i < 3; ++i)
        color[i] *= static_cast<float>(reading_.scene.materials[material].color[i]);
    return color;
  }

  std::vector<model::Rgb> colors_of(const aiMesh& mesh, std::size_t material) const {
    std::vector<model::Rgb> colors;
    if (!mesh.HasVertexColors(0)) return colors;
    colors.reserve(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i)
      colors.push_back(vertex_color(mesh, i, material));
    return colors;
  }

  /// STL's normals are those of its triangles.
  std::vector<model::Triple> normals_of(const aiMesh& mesh) {
    std::vector<model::Triple> normals;
    if (!mesh.HasNormals() || format_ == MeshFormat::stl) return normals;
    normals.reserve(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& normal = mesh.mNormals[i];
      if (!is_place(normal) || !(normal.SquareLength() > 0)) {
        omit(1, "mesh with normals that have no direction, shown without them",
             "meshes with normals that have no direction, shown without them");
        return {};
      }
      normals.push_back(triple(normal));
    }
    return normals;
  }

  void add_triangles(const aiMesh& file, std::size_t material) {
    model::Mesh mesh;
    mesh.vertices.reserve(file.mNumVertices);
    for (unsigned i = 0; i < file.mNumVertices; ++i) {
      if (!is_place(file.mVertices[i])) throw InputError("has a vertex without a place");
      mesh.vertices.push_back(triple(file.mVertices[i]));
    }
    mesh.normals = normals_of(file);
    mesh.colors = colors_of(file, material);
    for (unsigned i = 0; i < file.mNumFaces; ++i) {
      const aiFace& face = file.mFaces[i];
      if (face.mNumIndices != 3) continue;
      std::array<std::uint32_t, 3> corners{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
      if (std::any_of(corners.begin(), corners.end(),
                      [&](std::uint32_t corner) { return corner >= file.mNumVertices; }))
        throw InputError("has a triangle with a corner that is none of its vertices");
      const aiVector3D a = file.mVertices[corners[1]] - file.mVertices[corners[0]];
      const aiVector3D b = file.mVertices[corners[2]] - file.mVertices[corners[0]];
      if (a == aiVector3D() || b == aiVector3D() || a == b) {
        has_flat_ = true;
        omit(1, "triangle without area left out", "triangles without area left out");
        continue;
      }
      // The normals tell the outside: a glTF's node that mirrors leaves the corners' order, and
      // writers of other formats care for one of both.
      const aiVector3D outward = a ^ b;
      if (!mesh.normals.empty() &&
          std::all_of(corners.begin(), corners.end(),
                      [&](std::uint32_t corner) { return outward * file.mNormals[corner] < 0; }))
        std::swap(corners[1], corners[2]);
      mesh.triangles.push_back(corners);
    }
    if (mesh.triangles.empty()) return;
    join_vertices(mesh);
    reading_.scene.objects.push_back({std::move(mesh), material});
  }

  void add_points(const aiMesh& file, std::size_t material) {
    model::Spheres points;
    for (unsigned i = 0; i < file.mNumVertices; ++i) {
      if (!is_place(file.mVertices[i])) {
        omit(1, "point without a place left out", "points without a place left out");
        continue;
      }
      if (file.HasVertexColors(0)) points.colors.push_back(vertex_color(file, i, material));
      points.centers.push_back(triple(file.mVertices[i]));
    }
    if (points.centers.empty()) return;
    points.radii.assign(points.centers.size(), typical_spacing(points.centers, 1) / 2);
    reading_.scene.objects.push_back({std::move(points), material});
  }

  MeshFormat format_;
  const aiScene& scene_;
  Reading& reading_;
  std::vector<bool> is_seen_;  ///< of the file's materials: a mask may leave nothing
  bool has_flat_ = false;      ///< triangles without area
};

}  // namespace

void raytracer_import_meshes(MeshFormat format, const std::string& path, std::string_view bytes,
                             Reading& reading) {
  Assimp::Importer importer;
  unsigned missing_files = 0;
  std::string known;
  if (format == MeshFormat::obj) bytes = known = obj_as_assimp_knows_it(bytes);
  if (auto ply = format == MeshFormat::ply ? ply_as_assimp_knows_it(bytes) : std::nullopt)
    bytes = known = *std::move(ply);
  // Assimp knows a format by the name's ending.
  const std::string name = path.empty()
                               ? std::string("mesh.") + endings[static_cast<std::size_t>(format)]
                               : std::string(without_compression(path));
  importer.SetIOHandler(new MeshFiles(name, bytes, !path.empty(), missing_files));  // takes it
  const aiScene* const scene =
      importer.ReadFile(name, aiProcess_Triangulate | aiProcess_SortByPType);
  const auto refuse = [&] {
    const std::string_view reason = importer.GetErrorString();
    if (reason.starts_with("No suitable reader found"))
      return InputError(
          "cannot be read: nothing in it is as files of its ending are; is it damaged?");
    return InputError("cannot be read: " + printable(reason));
  };
  if (!scene) throw refuse();
  MeshImport import(format, *scene, reading);
  import.count_omissions(missing_files > 0);
  if (import.has_faces() && !importer.ApplyPostProcessing(aiProcess_PreTransformVertices))
    throw refuse();
  import.read();
}

}  // namespace raytracer::client

#include "client/formats/meshes/import_meshes.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "client/failure.h"
#include "client/formats/meshes/assimp_files.h"
#include "client/formats/meshes/join_vertices.h"
#include "client/formats/meshes/mesh_material.h"
#include "client/formats/meshes/obj_text.h"
#include "client/formats/meshes/ply_as_assimp_knows_it.h"
#include "client/formats/meshes/ply_radii.h"
#include "client/formats/numbers.h"
#include "client/formats/printable.h"
#include "client/formats/spacing.h"
#include "client/formats/text_source.h"

namespace raytracer::client {
namespace {

constexpr std::array<const char*, 5> endings{"ply", "obj", "stl", "gltf", "glb"};

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

  /// Of the file's points; none: as is typical of their distances.
  void set_radii(std::vector<double> radii) { radii_ = std::move(radii); }

  void read() {
    std::vector<bool> is_used(scene_.mNumMaterials);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      if (const unsigned used = scene_.mMeshes[i]->mMaterialIndex; used < is_used.size())
        is_used[used] = true;
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      const auto [material, is_seen] = material_of(format_, *scene_.mMaterials[i]);
      reading_.scene.materials.push_back(material);
      is_seen_.push_back(is_seen);
      if (is_used[i]) tell_of(format_, *scene_.mMaterials[i], reading_);
    }
    if (scene_.mNumMaterials == 0) reading_.scene.materials.push_back(plain_material());
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
    model::Rgb color = light(format_, mesh.mColors[0][vertex]);
    if (is_gltf(format_))
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
    const bool has_radii = radii_.size() == file.mNumVertices;
    for (unsigned i = 0; i < file.mNumVertices; ++i) {
      if (!is_place(file.mVertices[i])) {
        omit(1, "point without a place left out", "points without a place left out");
        continue;
      }
      if (file.HasVertexColors(0)) points.colors.push_back(vertex_color(file, i, material));
      if (has_radii) points.radii.push_back(radii_[i]);
      points.centers.push_back(triple(file.mVertices[i]));
    }
    if (points.centers.empty()) return;
    if (!has_radii)
      points.radii.assign(points.centers.size(), typical_spacing(points.centers, 1) / 2);
    reading_.scene.objects.push_back({std::move(points), material});
  }

  MeshFormat format_;
  const aiScene& scene_;
  Reading& reading_;
  std::vector<bool> is_seen_;  ///< of the file's materials
  std::vector<double> radii_;
  bool has_flat_ = false;  ///< triangles without area
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
  importer.SetIOHandler(new AssimpFiles(name, bytes, !path.empty(), missing_files));  // takes it
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
  if (!import.has_faces()) {
    if (format == MeshFormat::ply) import.set_radii(read_ply_radii(bytes, reading));
  } else if (!importer.ApplyPostProcessing(aiProcess_PreTransformVertices)) {
    throw refuse();
  }
  import.read();
}

}  // namespace raytracer::client

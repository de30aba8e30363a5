#include "client/formats/meshes/reading_bytes.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <variant>

#include "client/failure.h"

namespace raytracer::client {
namespace {

/// One list of fields for both ways.
class ByteWriter {
 public:
  std::string bytes;

  template <typename Value>
  requires std::is_trivially_copyable_v<Value>
  void field(const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename Value>
  void list(const std::vector<Value>& all) {
    field(all.size());
    bytes.append(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(Value));
  }
  void text(const std::string& text) {
    field(text.size());
    bytes += text;
  }
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename Value>
  requires std::is_trivially_copyable_v<Value>
  void field(Value& value) { std::memcpy(&value, take(sizeof value), sizeof value); }
  template <typename Value>
  void list(std::vector<Value>& all) {
    const std::size_t count = size();
    if (count > bytes_.size() / sizeof(Value)) throw damaged();
    all.resize(count);
    if (count > 0) std::memcpy(all.data(), take(count * sizeof(Value)), count * sizeof(Value));
  }
  void text(std::string& text) {
    const std::size_t count = size();
    text.assign(take(count), count);
  }
  std::size_t size() {
    std::size_t count = 0;
    field(count);
    return count;
  }
  static InputError damaged() { return InputError("is damaged: its reader broke off"); }

 private:
  const char* take(std::size_t count) {
    if (count > bytes_.size()) throw damaged();
    const char* const begin = bytes_.data();
    bytes_.remove_prefix(count);
    return begin;
  }

  std::string_view bytes_;
};

template <typename Bytes, typename Mesh>
void mesh_fields(Bytes& bytes, Mesh& mesh) {
  bytes.list(mesh.vertices);
  bytes.list(mesh.normals);
  bytes.list(mesh.colors);
  bytes.list(mesh.triangles);
}

template <typename Bytes, typename Spheres>
void sphere_fields(Bytes& bytes, Spheres& spheres) {
  bytes.list(spheres.centers);
  bytes.list(spheres.radii);
  bytes.list(spheres.colors);
}

template <typename Bytes, typename Material>
void material_fields(Bytes& bytes, Material& material) {
  bytes.field(material.color);
  bytes.field(material.kd);
  bytes.field(material.ks);
  bytes.field(material.shininess);
  bytes.field(material.reflectivity);
  bytes.field(material.transparency);
  bytes.field(material.ior);
}

template <typename Bytes, typename Scene>
void stage_fields(Bytes& bytes, Scene& scene) {
  bytes.field(scene.camera);
  bytes.list(scene.lights);
}

template <typename Bytes, typename Omission>
void omission_fields(Bytes& bytes, Omission& omission) {
  bytes.text(omission.one);
  bytes.text(omission.many);
  bytes.field(omission.count);
  bytes.field(omission.first_line);
}

template <typename Bytes, typename Error>
void error_fields(Bytes& bytes, Error& error) {
  bytes.field(error.line);
  bytes.text(error.what);
}

/// Indices that are not among the others' would be read from anywhere.
bool is_whole(const model::Mesh& mesh) {
  const auto has_vertex = [&](std::uint32_t index) { return index < mesh.vertices.size(); };
  const auto fits = [&](std::size_t count) { return count == 0 || count == mesh.vertices.size(); };
  return fits(mesh.normals.size()) && fits(mesh.colors.size()) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
           return std::all_of(triangle.begin(), triangle.end(), has_vertex);
         });
}

bool is_whole(const model::Spheres& spheres) {
  const std::size_t count = spheres.centers.size();
  return spheres.radii.size() == count &&
         (spheres.colors.empty() || spheres.colors.size() == count);
}

}  // namespace

std::string bytes_of(const Reading& reading) {
  ByteWriter bytes;
  stage_fields(bytes, reading.scene);
  bytes.field(reading.scene.materials.size());
  for (const model::Material& material : reading.scene.materials) material_fields(bytes, material);
  bytes.field(reading.scene.objects.size());
  for (const model::Objects& objects : reading.scene.objects) {
    const auto* const mesh = std::get_if<model::Mesh>(&objects.shape);
    bytes.field(mesh != nullptr);
    if (mesh)
      mesh_fields(bytes, *mesh);
    else
      sphere_fields(bytes, std::get<model::Spheres>(objects.shape));
    bytes.field(objects.material.value_or(0));
  }
  bytes.field(reading.omissions.size());
  for (const Omission& omission : reading.omissions) omission_fields(bytes, omission);
  bytes.field(reading.errors.size());
  for (const LineError& error : reading.errors) error_fields(bytes, error);
  return std::move(bytes.bytes);
}

Reading reading_of(std::string_view all) {
  ByteReader bytes(all);
  Reading reading;
  stage_fields(bytes, reading.scene);
  for (const model::Light& light : reading.scene.lights)
    if (light.index() >= std::variant_size_v<model::Light>) throw ByteReader::damaged();
  for (std::size_t left = bytes.size(); left > 0; --left)
    material_fields(bytes, reading.scene.materials.emplace_back());
  for (std::size_t left = bytes.size(); left > 0; --left) {
    model::Objects& objects = reading.scene.objects.emplace_back();
    bool is_mesh = false;
    bytes.field(is_mesh);
    if (is_mesh) {
      auto& mesh = objects.shape.emplace<model::Mesh>();
      mesh_fields(bytes, mesh);
      if (!is_whole(mesh)) throw ByteReader::damaged();
    } else {
      auto& spheres = objects.shape.emplace<model::Spheres>();
      sphere_fields(bytes, spheres);
      if (!is_whole(spheres)) throw ByteReader::damaged();
    }
    objects.material = bytes.size();
    if (*objects.material >= reading.scene.materials.size()) throw ByteReader::damaged();
  }
  for (std::size_t left = bytes.size(); left > 0; --left)
    omission_fields(bytes, reading.omissions.emplace_back());
  for (std::size_t left = bytes.size(); left > 0; --left)
    error_fields(bytes, reading.errors.emplace_back());
  return reading;
}

}  // namespace raytracer::client

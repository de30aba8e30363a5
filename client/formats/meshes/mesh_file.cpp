#include "client/formats/meshes/mesh_file.h"

#include <dlfcn.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "client/failure.h"
#include "client/formats/arrange.h"
#include "client/formats/meshes/check_gltf.h"
#include "client/formats/meshes/check_obj.h"
#include "client/formats/meshes/check_ply.h"
#include "client/formats/meshes/check_stl.h"
#include "client/formats/meshes/gltf_extensions.h"
#include "client/formats/meshes/gltf_stage.h"
#include "client/formats/meshes/import_meshes.h"
#include "client/formats/meshes/own_process.h"
#include "client/formats/meshes/reading_bytes.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

/// Loads the library, which is found where the program was linked to look for libraries.
ImportMeshes& importer() {
  void* const library = dlopen(RAYTRACER_MESHES, RTLD_NOW);
  void* const function = library ? dlsym(library, "raytracer_import_meshes") : nullptr;
  if (!function)
    throw InputError(std::string("cannot be read without a part of this program: ") + dlerror());
  return *reinterpret_cast<ImportMeshes*>(function);
}

/// A file of that name beside one that is read from `path`.
std::optional<std::string> file_beside(const std::string& path, std::string_view name) {
  const std::filesystem::path beside = std::filesystem::path(path).parent_path() / name;
  std::error_code unknown;
  if (path.empty() || !std::filesystem::is_regular_file(beside, unknown)) return std::nullopt;
  std::ifstream file(beside, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return file ? std::optional(std::move(bytes)) : std::nullopt;
}

void check(MeshFormat format, std::string_view bytes, const std::string& path, Reading& reading) {
  switch (format) {
    case MeshFormat::ply:
      return check_ply(bytes, reading);
    case MeshFormat::obj:
      return check_obj(
          bytes, [&](std::string_view name) { return file_beside(path, name); }, reading);
    case MeshFormat::stl:
      return check_stl(bytes, reading);
    case MeshFormat::gltf:
      return check_gltf(bytes, reading);
    case MeshFormat::glb:
      return check_glb(bytes);
  }
}

/// Of a size that is known, which may be more than a gigabyte.
std::string read_plain(TextSource& source, std::size_t size) {
  std::string bytes(size, '\0');
  std::size_t count = 0;
  while (const std::size_t more = source.read(std::span(bytes).subspan(count))) count += more;
  bytes.resize(count);
  return bytes;
}

/// Of one frame.
class MeshFile : public SceneFile {
 public:
  MeshFile(MeshFormat format, FileInput input, ImportOptions options)
      : format_(format), input_(std::move(input)), options_(std::move(options)) {}

  std::optional<Reading> next_frame() override {
    if (!has_more()) return std::nullopt;
    const auto source = std::exchange(input_.source, nullptr);
    const bool is_plain = !input_.path.empty() && without_compression(input_.path) == input_.path;
    std::error_code unknown;
    const auto size = is_plain ? std::filesystem::file_size(input_.path, unknown) : 0;
    // What says no size, as a pipe, is read whole before its process, as what is compressed.
    const bool is_read_there = is_plain && !unknown;
    std::string bytes = is_read_there ? "" : read_all(*source);
    const std::size_t known_size = is_read_there ? static_cast<std::size_t>(size) : bytes.size();
    // A vertex of a text takes some thirty bytes, one of assimp's with its face a hundred and more,
    // several times.
    const ProcessLimits limits{(std::size_t{768} << 20) + 60 * known_size,
                               static_cast<unsigned>(3 + (known_size >> 22))};
    Reading reading = reading_of(in_own_process(limits, [&] {
      if (is_read_there) bytes = read_plain(*source, known_size);
      Reading imported;
      check(format_, bytes, input_.path, imported);
      if (imported.errors.empty()) import(bytes, imported);
      return bytes_of(imported);
    }));
    if (!reading.errors.empty()) return reading;
    arrange(reading.scene, options_, view_of(reading.scene));
    return reading;
  }

  bool has_more() const override { return input_.source != nullptr; }

 private:
  void import(std::string_view bytes, Reading& reading) const {
    if (format_ == MeshFormat::gltf) bytes = without_byte_order_mark(bytes);
    if (format_ == MeshFormat::gltf) check_extensions(bytes, reading);
    if (format_ == MeshFormat::glb) check_extensions(text_of_glb(bytes), reading);
    importer()(format_, input_.path, bytes, reading);
    if (format_ == MeshFormat::gltf) read_gltf_stage(bytes, reading);
    if (format_ == MeshFormat::glb) read_gltf_stage(text_of_glb(bytes), reading);
  }

  /// A direction that is asked for is another view than the file's, and a camera that looks down
  /// would go round under the ground.
  model::View view_of(const model::Scene& scene) const {
    if (scene.camera && !options_.view && !options_.is_turned)
      return view_through(*scene.camera, scene, options_);
    return view_of_all(scene, options_, format_ == MeshFormat::stl ? Upright::z : Upright::y);
  }

  MeshFormat format_;
  FileInput input_;
  ImportOptions options_;
};

std::unique_ptr<SceneFile> open_mesh(MeshFormat format, FileInput& input,
                                     const ImportOptions& options) {
  return std::make_unique<MeshFile>(format, std::move(input), options);
}

}  // namespace

std::unique_ptr<SceneFile> open_ply(FileInput input, const ImportOptions& options) {
  return open_mesh(MeshFormat::ply, input, options);
}

std::unique_ptr<SceneFile> open_obj(FileInput input, const ImportOptions& options) {
  return open_mesh(MeshFormat::obj, input, options);
}

std::unique_ptr<SceneFile> open_stl(FileInput input, const ImportOptions& options) {
  return open_mesh(MeshFormat::stl, input, options);
}

std::unique_ptr<SceneFile> open_gltf(FileInput input, const ImportOptions& options) {
  return open_mesh(MeshFormat::gltf, input, options);
}

std::unique_ptr<SceneFile> open_glb(FileInput input, const ImportOptions& options) {
  return open_mesh(MeshFormat::glb, input, options);
}

}  // namespace raytracer::client

#include "client/formats/meshes/mesh_file.h"

#include <dlfcn.h>

#include <filesystem>
#include <utility>

#include "client/failure.h"
#include "client/formats/arrange.h"
#include "client/formats/meshes/import_meshes.h"
#include "client/formats/meshes/own_process.h"
#include "client/formats/meshes/reading_bytes.h"

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

/// Of one frame.
class MeshFile : public SceneFile {
 public:
  MeshFile(MeshFormat format, FileInput input, Wishes wishes)
      : format_(format), input_(std::move(input)), wishes_(std::move(wishes)) {}

  std::optional<Reading> next_frame() override {
    if (!has_more()) return std::nullopt;
    const auto source = std::exchange(input_.source, nullptr);
    const bool is_plain = !input_.path.empty() && without_compression(input_.path) == input_.path;
    const std::string text = is_plain ? "" : read_all(*source);
    std::error_code unknown;
    const std::size_t size =
        is_plain ? static_cast<std::size_t>(std::filesystem::file_size(input_.path, unknown))
                 : text.size();
    // A vertex of a text takes some thirty bytes, one of assimp's with its face a hundred and more,
    // several times.
    const std::size_t known_size = unknown ? 0 : size;
    const ProcessLimits limits{(std::size_t{768} << 20) + 60 * known_size,
                               static_cast<unsigned>(3 + (known_size >> 22))};
    Reading reading = reading_of(in_own_process(limits, [&] {
      Reading imported;
      importer()(format_, input_.path, text, imported);
      return bytes_of(imported);
    }));
    arrange(
        reading.scene, wishes_,
        view_of_all(reading.scene, wishes_, format_ == MeshFormat::stl ? Upright::z : Upright::y));
    return reading;
  }

  bool has_more() const override { return input_.source != nullptr; }

 private:
  MeshFormat format_;
  FileInput input_;
  Wishes wishes_;
};

std::unique_ptr<SceneFile> open_mesh(MeshFormat format, FileInput& input, const Wishes& wishes) {
  return std::make_unique<MeshFile>(format, std::move(input), wishes);
}

}  // namespace

std::unique_ptr<SceneFile> open_ply(FileInput input, const Wishes& wishes) {
  return open_mesh(MeshFormat::ply, input, wishes);
}

std::unique_ptr<SceneFile> open_obj(FileInput input, const Wishes& wishes) {
  return open_mesh(MeshFormat::obj, input, wishes);
}

std::unique_ptr<SceneFile> open_stl(FileInput input, const Wishes& wishes) {
  return open_mesh(MeshFormat::stl, input, wishes);
}

std::unique_ptr<SceneFile> open_gltf(FileInput input, const Wishes& wishes) {
  return open_mesh(MeshFormat::gltf, input, wishes);
}

std::unique_ptr<SceneFile> open_glb(FileInput input, const Wishes& wishes) {
  return open_mesh(MeshFormat::glb, input, wishes);
}

}  // namespace raytracer::client

#include "client/formats/meshes/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/failure.h"

namespace raytracer::client {
namespace {

/// Whether it is about light, or how what is shown of a surface is told.
bool is_known(std::string_view extension) {
  static constexpr std::array<std::string_view, 6> beginnings{
      "KHR_lights_punctual", "KHR_materials_", "KHR_texture_",
      "EXT_texture_",        "MSFT_texture_",  "KHR_xmp"};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view known) { return extension.starts_with(known); });
}

bool changes_geometry(std::string_view extension) {
  static constexpr std::array<std::string_view, 6> all{"KHR_mesh_quantization",
                                                       "KHR_draco_mesh_compression",
                                                       "EXT_meshopt_compression",
                                                       "EXT_mesh_gpu_instancing",
                                                       "CESIUM_RTC",
                                                       "KHR_node_visibility"};
  return std::find(all.begin(), all.end(), extension) != all.end();
}

}  // namespace

void check_extensions(std::string_view text, Reading& reading) {
  const nlohmann::json file = nlohmann::json::parse(text, nullptr, false);
  if (!file.is_object()) return;
  const auto required = file.find("extensionsRequired");
  if (required == file.end() || !required->is_array()) return;
  std::vector<std::string> needed;
  for (const nlohmann::json& extension : *required) {
    if (!extension.is_string()) continue;
    const auto& name = extension.get_ref<const std::string&>();
    if (changes_geometry(name))
      needed.push_back(name);
    else if (!is_known(name))
      reading.omit(0, "extension that the file requires left out",
                   "extensions that the file requires left out");
  }
  if (!needed.empty())
    throw InputError(fmt::format("cannot be read: it requires {}; export it without",
                                 fmt::join(needed, " and ")));
}

}  // namespace raytracer::client

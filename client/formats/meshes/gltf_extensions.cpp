#include "client/formats/meshes/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/failure.h"
#include "client/formats/printable.h"

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

}  // namespace

void require_known_extensions(std::string_view text) {
  const nlohmann::json file = nlohmann::json::parse(text, nullptr, false);
  if (!file.is_object()) return;
  std::vector<std::string> unknown;
  const auto required = file.find("extensionsRequired");
  if (required == file.end() || !required->is_array()) return;
  for (const nlohmann::json& extension : *required)
    if (extension.is_string() && !is_known(extension.get_ref<const std::string&>()))
      unknown.push_back(printable(extension.get<std::string>()));
  if (!unknown.empty())
    throw InputError(fmt::format("cannot be read: it requires {}; export it without",
                                 fmt::join(unknown, " and ")));
}

}  // namespace raytracer::client

#include "client/formats/format.h"

#include <algorithm>

#include "client/formats/ascii.h"

namespace raytracer::client {

const Format* format_of(std::string_view path) {
  path = without_compression(path);
  const auto* const format = std::find_if(
      formats.begin(), formats.end(),
      [&](const Format& candidate) { return ends_in_any_case(path, candidate.ending); });
  if (format != formats.end()) return format;
  // LAMMPS's own examples write dump.melt: what ends other formats begins the name.
  const std::string_view name = path.substr(path.rfind('/') + 1);
  return name.starts_with("dump.") ? format_of("a.dump") : nullptr;
}

std::string all_endings() {
  std::string endings;
  for (const Format& format : formats) {
    if (!endings.empty()) endings += ", ";
    endings += format.ending;
  }
  return endings;
}

}  // namespace raytracer::client

#include "client/formats/format.h"

#include <algorithm>

namespace raytracer::client {

const Format* format_of(std::string_view path) {
  path = without_compression(path);
  const auto is_same = [](char a, char b) {
    return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
  };
  const auto* const format =
      std::find_if(formats.begin(), formats.end(), [&](const Format& candidate) {
        const std::string_view ending = candidate.ending;
        return path.size() >= ending.size() &&
               std::equal(ending.begin(), ending.end(), path.end() - ending.size(), is_same);
      });
  return format == formats.end() ? nullptr : format;
}

}  // namespace raytracer::client

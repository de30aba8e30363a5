// Looking the embedded files up, and the one table from a name to its media type.
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "server/embedded.h"

namespace raytracer {

const EmbeddedFile& embedded_file(std::string_view path) {
  for (const EmbeddedFile& file : embedded_files())
    if (file.path == path) return file;
  throw std::logic_error(std::string(path) + " is not embedded");
}

std::string_view media_type_of(std::string_view path) {
  using namespace std::string_view_literals;
  constexpr std::array types{
      std::pair{".html"sv, "text/html; charset=utf-8"sv},
      std::pair{".css"sv, "text/css; charset=utf-8"sv},
      std::pair{".js"sv, "text/javascript; charset=utf-8"sv},
      std::pair{".json"sv, "application/json"sv},
      std::pair{".svg"sv, "image/svg+xml"sv},
      std::pair{".png"sv, "image/png"sv},
  };
  for (const auto& [ending, type] : types)
    if (path.ends_with(ending)) return type;
  return "application/octet-stream";
}

}  // namespace raytracer

#include "client/formats/printable.h"

#include <fmt/format.h>

namespace raytracer::client {

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr unsigned char del = 0x7F;
    if (byte < ' ' || byte == del)
      result += fmt::format("\\u{:04x}", byte);
    else
      result += c;
  }
  return result;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t most = 40;
  return fmt::format("'{}{}'", printable(word.substr(0, most)), word.size() > most ? "..." : "");
}

}  // namespace raytracer::client

#include "client/formats/meshes/check_gltf.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "client/failure.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

struct OpenBracket {
  char closing;
  int line;
};

/// Goes to the quotation mark that ends the string; to the end of the text if there is none.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at)
    if (text[at] == '\\') ++at;
  return at;
}

/// Four bytes, the last of which counts most.
std::size_t number_at(std::string_view bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = at + 4; i > at; --i)
    number = number << 8 | static_cast<unsigned char>(bytes.at(i - 1));
  return number;
}

constexpr std::size_t glb_header = 12;
constexpr std::size_t chunk_header = 8;

}  // namespace

void check_gltf(std::string_view text, Reading& reading) {
  text = without_byte_order_mark(text);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos || text[begin] != '{')
    throw InputError("is no glTF: it is not JSON, which begins with {");
  std::vector<OpenBracket> open;
  int line = 1;
  const auto wrong = [&](int where, std::string what) {
    reading.errors.push_back({where, "is no JSON: " + std::move(what)});
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n' && at + 1 < text.size()) ++line;
    if (c == '"') {
      at = end_of_string(text, at);
      if (at >= text.size() || text[at] != '"') return wrong(line, "a string does not end");
    } else if (c == '{' || c == '[') {
      open.push_back({c == '{' ? '}' : ']', line});
    } else if (c == '}' || c == ']') {
      if (open.empty() || open.back().closing != c)
        return wrong(line, open.empty() ? fmt::format("{} closes nothing", c)
                                        : fmt::format("{} stands where {} is to close line {}'s", c,
                                                      open.back().closing, open.back().line));
      open.pop_back();
    }
  }
  if (!open.empty())
    wrong(line, fmt::format("the file ends before the {} of line {}", open.back().closing,
                            open.back().line));
}

void check_glb(std::string_view bytes) {
  if (!bytes.starts_with("glTF") || bytes.size() < glb_header)
    throw InputError("is no binary glTF, which begins with the letters glTF");
  const std::size_t length = number_at(bytes, 8);
  if (bytes.size() < length)
    throw InputError(fmt::format("the file ends after {} of {} bytes", bytes.size(), length));
}

std::string_view text_of_glb(std::string_view bytes) {
  if (bytes.size() < glb_header + chunk_header) return {};
  return bytes.substr(glb_header + chunk_header, number_at(bytes, glb_header));
}

}  // namespace raytracer::client

#include "client/scene_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "client/pointer_position.h"

namespace raytracer::client {
namespace {

/// Every position is looked for from the scene's beginning: beyond this many bytes in all (about
/// a second) the pointers have to do.
constexpr std::size_t most_bytes_scanned = 500'000'000;

/// The option that put the value of `pointer` over the scene's own; empty if none did.
std::string overriding_option(const std::string& pointer, const Overrides& overrides) {
  std::string name = pointer.substr(pointer.rfind('/') + 1);
  const bool in_place = pointer == "/camera/" + name || pointer == "/render/" + name;
  if (!in_place || !overrides.contains(name)) return {};
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::string place_of(const SceneError& error, const SceneSource& scene, const Overrides& overrides,
                     bool with_position) {
  std::string option = overriding_option(error.pointer, overrides);
  if (!option.empty()) return option;
  if (!with_position || error.pointer.empty()) return scene.label;
  const TextPosition position = position_of(scene.text, error.pointer);
  if (position.line == 0) return scene.label;
  return fmt::format("{}:{}:{}", scene.label, position.line, position.column);
}

/// In one line, whatever the document calls its keys: nothing in it moves the terminal's cursor.
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

}  // namespace

InputError explain(const Refused& refused, const SceneSource& scene, const Overrides& overrides) {
  if (refused.errors().empty()) return InputError(scene.label + ": " + refused.what());
  const bool with_position =
      scene.editable && scene.text.size() * refused.errors().size() <= most_bytes_scanned;
  std::string lines;
  for (const SceneError& error : refused.errors())
    lines += fmt::format("{}{}: {}{}{}", lines.empty() ? "" : "\n",
                         place_of(error, scene, overrides, with_position), printable(error.pointer),
                         error.pointer.empty() ? "" : ": ", printable(error.detail));
  return InputError(lines);
}

}  // namespace raytracer::client

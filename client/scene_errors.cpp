#include "client/scene_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "client/formats/printable.h"
#include "client/pointer_lines.h"

namespace raytracer::client {
namespace {

/// The option that put the value of `pointer` over the scene's own; empty if none did.
std::string overriding_option(const std::string& pointer, const Overrides& overrides) {
  std::string name = pointer.substr(pointer.rfind('/') + 1);
  const bool in_place = pointer == "/camera/" + name || pointer == "/render/" + name;
  if (!in_place || !overrides.contains(name)) return {};
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

}  // namespace

std::string explain(const std::string& problem, const SceneText& scene,
                    const Overrides& overrides) {
  const auto document = nlohmann::json::parse(problem, nullptr, false);
  if (!document.is_object()) return scene.label + ": was refused, without a reason";
  const auto errors = document.value("errors", nlohmann::json::array());
  if (errors.empty())
    return fmt::format("{}: {}", scene.label, document.value("detail", "was refused"));

  std::vector<std::string> pointers;
  for (const auto& error : errors) pointers.push_back(error.value("pointer", ""));
  std::map<std::string, int> lines;
  if (scene.editable) lines = lines_of(pointers, scene.text);
  const auto place_of = [&](std::string pointer) {
    if (std::string option = overriding_option(pointer, overrides); !option.empty()) return option;
    while (!pointer.empty() && !lines.contains(pointer)) pointer.erase(pointer.rfind('/'));
    const auto line = lines.find(pointer);
    return line == lines.end() ? scene.label : fmt::format("{}:{}", scene.label, line->second);
  };
  // What is wrong with the whole text has a line if that is not JSON.
  const auto place_in_text = [&](const nlohmann::json& error) {
    const int line = error.value("line", 0);
    return line > 0 ? fmt::format("{}:{}", scene.label, line) : scene.label;
  };
  std::vector<std::string> text;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::string detail = printable(errors[i].value("detail", ""));
    text.push_back(pointers[i].empty() ? fmt::format("{}: {}", place_in_text(errors[i]), detail)
                                       : fmt::format("{}: {}: {}", place_of(pointers[i]),
                                                     printable(pointers[i]), detail));
  }
  return fmt::format("{}", fmt::join(text, "\n"));
}

}  // namespace raytracer::client

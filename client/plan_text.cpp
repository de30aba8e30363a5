#include "client/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

namespace raytracer::client {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t margin = 17;  // of the reasons: wider than any name

/// Appends the words to `line`, and goes on in further lines under `margin` spaces.
std::string wrapped(std::string line, const std::string& words, int columns) {
  std::string text;
  std::istringstream stream(words);
  bool is_first = true;
  for (std::string word; stream >> word; is_first = false) {
    const std::size_t space = is_first ? 0 : 1;
    if (!is_first && line.size() + space + word.size() > static_cast<std::size_t>(columns)) {
      text += line + '\n';
      line = std::string(margin, ' ') + word;
    } else {
      line += (is_first ? "" : " ") + word;
    }
  }
  return text + line + '\n';
}

std::string entry(const std::string& name, const std::string& words, int columns) {
  return wrapped(fmt::format("{:<{}}", name, margin), words, columns);
}

std::string word_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// {"spheres": 2, "planes": 0} as "2 spheres".
std::vector<std::string> counts(const Json& object) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : object.items()) {
    if (!count.is_number() || count == 0) continue;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (count == 1 && words.ends_with('s')) words.pop_back();
    parts.push_back(fmt::format("{} {}", count.dump(), words));
  }
  return parts;
}

std::string features_text(const Json& features, int columns) {
  std::vector<std::string> needs;
  const auto add = [&](const std::vector<std::string>& parts) {
    needs.insert(needs.end(), parts.begin(), parts.end());
  };
  add(counts(features.value("objects", Json::object())));
  const Json lights = features.value("lights", Json::object());
  for (const auto& [kind, count] : lights.items())
    if (count != 0)
      needs.push_back(fmt::format("{} {} light{}", count.dump(), kind, count == 1 ? "" : "s"));
  const std::string shadows = features.value("shadows", "");
  if (shadows == "black" || shadows == "ambient") needs.push_back("shadows (" + shadows + ")");
  const Json shading = features.value("shading", Json::array());
  for (const Json& part : shading) needs.push_back(word_of(part) + " shading");
  const int reflections = features.value("reflections", 0);
  if (reflections > 0)
    needs.push_back(fmt::format("reflections, at most {} in a row", reflections));
  return entry("needs", needs.empty() ? "nothing but the background" : joined(needs), columns);
}

std::string choice_text(const std::string& name, const Json& choice, int columns) {
  std::string text = entry(name, word_of(choice.at("choice")), columns);
  if (!choice.contains("finders")) return text + entry("", choice.value("reason", ""), columns);
  for (const Json& row : choice.at("finders"))
    text +=
        entry("",
              fmt::format("- {} {}: {}, because {}", row.value("objects", ""),
                          row.value("rays", ""), row.value("choice", ""), row.value("reason", "")),
              columns);
  return text;
}

std::string prediction_text(const Json& prediction, int columns) {
  const auto number = [&](const char* key) {
    return prediction.contains(key) ? fmt::format("{:.3g}", prediction.value(key, 0.0)) : "?";
  };
  return entry("predicted time",
               fmt::format("{} ms to build, {} ms to trace on {} threads", number("build_ms"),
                           number("trace_ms"), number("threads")),
               columns) +
         entry("", prediction.value("time_reason", ""), columns) +
         entry("predicted error",
               fmt::format("{} with {} samples per pixel", number("error"), number("samples")),
               columns) +
         entry("", prediction.value("error_reason", ""), columns);
}

std::string health_text(const Json& strains, int columns) {
  if (strains.empty()) return entry("health", "nothing strains the arithmetic", columns);
  std::string text;
  for (const Json& strain : strains)
    text += entry(text.empty() ? "health" : "", "- " + word_of(strain), columns);
  return text;
}

}  // namespace

std::string plan_text(const std::string& json, int columns) {
  const Json plan = Json::parse(json);
  std::string text;
  for (const auto& [key, value] : plan.items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    if (key == "features")
      text += features_text(value, columns);
    else if (key == "prediction")
      text += prediction_text(value, columns);
    else if (key == "health")
      text += health_text(value, columns);
    else if (value.is_object() && value.contains("choice"))
      text += choice_text(name, value, columns);
  }
  return text;
}

}  // namespace raytracer::client

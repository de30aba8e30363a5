#include "client/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "client/failure.h"

namespace raytracer::client {
namespace {

using Json = nlohmann::ordered_json;

std::string word_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string name_of(const Json& settings) {
  std::vector<std::string> words;
  for (const auto& [key, value] : settings.items()) {
    if (key == "samples")
      words.push_back(value.dump() + (value == 1 ? " sample" : " samples"));
    else if (key == "target_rmse")
      words.push_back("target " + value.dump());
    else if (key == "shadows")
      words.emplace_back("no shadows");
    else if (key == "max_depth")
      words.push_back(value == 0 ? "no reflections" : value.dump() + " reflections");
    else
      words.push_back(word_of(value));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string options_of(const Json& settings) {
  std::vector<std::string> options;
  for (const auto& [key, value] : settings.items()) {
    std::string option = "--" + key;
    std::replace(option.begin(), option.end(), '_', '-');
    options.push_back(option + ' ' + word_of(value));
  }
  return fmt::format("{}", fmt::join(options, " "));
}

CurvePoint read_point(const Json& point) {
  const Json& settings = point.at("settings");
  return {name_of(settings),
          options_of(settings),
          settings.contains("target_rmse"),
          settings.value("precision", "") == "double",
          point.at("trace_ms").get<double>(),
          point.at("rmse").get<double>(),
          point.at("max_error").get<double>(),
          point.at("off_share").get<double>(),
          point.at("changes_picture").get<bool>(),
          point.at("pareto").get<bool>()};
}

/// What `read` makes of the text; its errors become ServerError.
template <typename Read>
auto read_json(const std::string& text, Read read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw ServerError(fmt::format("the server's answer is no curve: {}", error.what()));
  }
}

}  // namespace

Curve read_curve(const std::string& text) {
  return read_json(text, [](const Json& json) {
    const Json& reference = json.at("reference");
    Curve curve{json.at("width").get<int>(),
                json.at("height").get<int>(),
                json.at("threads").get<int>(),
                reference.at("samples").get<int>(),
                reference.at("estimated_error").get<double>(),
                {}};
    for (const Json& point : json.at("points")) curve.points.push_back(read_point(point));
    std::stable_sort(
        curve.points.begin(), curve.points.end(),
        [](const CurvePoint& a, const CurvePoint& b) { return a.trace_ms < b.trace_ms; });
    return curve;
  });
}

std::string curve_csv(const std::string& text) {
  constexpr std::array settings{"samples", "target_rmse", "precision", "shadows", "max_depth"};
  constexpr std::array figures{"trace_ms",        "rmse",  "max_error", "off_share",
                               "changes_picture", "pareto"};
  return read_json(text, [&](const Json& json) {
    std::string csv = fmt::format("{},{}\n", fmt::join(settings, ","), fmt::join(figures, ","));
    for (const Json& point : json.at("points")) {
      std::vector<std::string> cells;
      cells.reserve(settings.size() + figures.size());
      for (const char* const key : settings)
        cells.push_back(word_of(point.at("settings").value(key, Json(""))));
      for (const char* const key : figures) cells.push_back(point.at(key).dump());
      csv += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return csv;
  });
}

const CurvePoint* cheapest(const Curve& curve, double rmse) {
  const auto found = std::find_if(
      curve.points.begin(), curve.points.end(),
      [rmse](const CurvePoint& point) { return !point.changes_picture && point.rmse <= rmse; });
  return found == curve.points.end() ? nullptr : &*found;
}

}  // namespace raytracer::client

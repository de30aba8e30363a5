#include "client/curve.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "client/failure.h"

namespace raytracer::client {
namespace {

using nlohmann::json;

CurveSettings read_settings(const json& object) {
  CurveSettings settings;
  if (object.contains("samples")) settings.samples = object.at("samples").get<int>();
  if (object.contains("target_rmse")) settings.target_rmse = object.at("target_rmse").get<double>();
  if (object.contains("max_depth")) settings.max_depth = object.at("max_depth").get<int>();
  settings.precision = object.value("precision", "");
  settings.shadows = object.value("shadows", "");
  return settings;
}

CurvePoint read_point(const json& object) {
  return {read_settings(object.at("settings")), object.at("trace_ms").get<double>(),
          object.at("rmse").get<double>(),      object.at("max_error").get<double>(),
          object.at("off_share").get<double>(), object.at("changes_picture").get<bool>(),
          object.at("pareto").get<bool>()};
}

void append(std::string& list, const char* separator, const std::string& part) {
  list += (list.empty() ? "" : separator) + part;
}

}  // namespace

Curve read_curve(const std::string& text) {
  try {
    const json object = json::parse(text);
    const json& reference = object.at("reference");
    Curve curve{object.at("width").get<int>(),
                object.at("height").get<int>(),
                object.at("threads").get<int>(),
                reference.at("samples").get<int>(),
                reference.at("estimated_error").get<double>(),
                {}};
    for (const json& point : object.at("points")) curve.points.push_back(read_point(point));
    return curve;
  } catch (const json::exception& error) {
    throw ServerError(fmt::format("the server's answer is no curve: {}", error.what()));
  }
}

std::string in_words(const CurveSettings& settings) {
  std::string words;
  if (settings.samples)
    append(words, ", ",
           fmt::format("{} sample{}", *settings.samples, *settings.samples == 1 ? "" : "s"));
  if (settings.target_rmse) append(words, ", ", fmt::format("target {:g}", *settings.target_rmse));
  if (!settings.precision.empty()) append(words, ", ", settings.precision);
  if (settings.shadows == "off") append(words, ", ", "no shadows");
  if (settings.max_depth)
    append(words, ", ",
           *settings.max_depth == 0 ? "no reflections"
                                    : fmt::format("{} reflections", *settings.max_depth));
  return words;
}

std::string as_options(const CurveSettings& settings) {
  std::string options;
  if (settings.samples) append(options, " ", fmt::format("--samples {}", *settings.samples));
  if (settings.target_rmse)
    append(options, " ", fmt::format("--target-rmse {:g}", *settings.target_rmse));
  if (!settings.precision.empty()) append(options, " ", "--precision " + settings.precision);
  if (settings.max_depth) append(options, " ", fmt::format("--max-depth {}", *settings.max_depth));
  return options;
}

const CurvePoint* cheapest(const Curve& curve, double rmse) {
  const CurvePoint* best = nullptr;
  for (const CurvePoint& point : curve.points)
    if (!point.changes_picture && point.rmse <= rmse && (!best || point.trace_ms < best->trace_ms))
      best = &point;
  return best;
}

}  // namespace raytracer::client

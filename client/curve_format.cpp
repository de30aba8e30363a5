#include "client/curve_format.h"

#include <fmt/format.h>

#include "client/image_format.h"

namespace raytracer::client {

std::optional<CurveFormat> curve_format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".svg") return CurveFormat::svg;
  if (ending == ".json") return CurveFormat::json;
  if (ending == ".csv") return CurveFormat::csv;
  return std::nullopt;
}

std::string csv(const Curve& curve) {
  const auto cell = [](const auto& value) { return value ? fmt::format("{}", *value) : ""; };
  std::string text =
      "samples,target_rmse,precision,shadows,max_depth,trace_ms,rmse,max_error,off_share,"
      "changes_picture,pareto\n";
  for (const CurvePoint& point : curve.points) {
    const CurveSettings& settings = point.settings;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", cell(settings.samples),
                        cell(settings.target_rmse), settings.precision, settings.shadows,
                        cell(settings.max_depth), point.trace_ms, point.rmse, point.max_error,
                        point.off_share, point.changes_picture, point.pareto);
  }
  return text;
}

}  // namespace raytracer::client

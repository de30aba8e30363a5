#include "server/tradeoff.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "server/problem.h"

namespace raytracer {
namespace {

using Json = nlohmann::ordered_json;

/// As the scene document and the query name them.
Json settings_json(const CurveSettings& settings) {
  Json json = Json::object();
  if (settings.samples) json["samples"] = *settings.samples;
  if (settings.target_rmse) json["target_rmse"] = *settings.target_rmse;
  if (settings.precision == Precision::single_precision) json["precision"] = "single";
  if (settings.precision == Precision::double_precision) json["precision"] = "double";
  if (settings.without_shadows) json["shadows"] = "off";
  if (settings.without_reflections) json["max_depth"] = 0;
  return json;
}

void add_error(Json& json, const Difference& error) {
  json["rmse"] = error.rmse;
  json["max_error"] = error.max_error;
  json["off_share"] = error.off_share;
}

Json point_json(const CurvePoint& point) {
  Json json{{"settings", settings_json(point.settings)}, {"trace_ms", point.trace_ms}};
  add_error(json, point.error);
  json["samples"] = point.samples_per_pixel;
  json["repetitions"] = point.repetitions;
  json["changes_picture"] = point.settings.changes_picture();
  json["pareto"] = point.pareto;
  return json;
}

Json contract_json(const CurvePoint& point) {
  Json json{{"target_rmse", *point.settings.target_rmse}, {"trace_ms", point.trace_ms}};
  add_error(json, point.error);
  json["estimated_error"] = nullptr;
  if (point.estimated_error) json["estimated_error"] = *point.estimated_error;
  json["samples"] = point.samples_per_pixel;
  return json;
}

[[noreturn]] void refuse_beyond(std::int64_t Limits::*limit, std::string detail) {
  const LimitRow& row = row_of(limit);
  throw HttpError(
      scene_problem({{ErrorKind::limit, "/render", fmt::format("{} ({})", detail, row.flag)}}));
}

}  // namespace

RenderQuery read_curve_query(const httplib::Params& params) {
  RenderQuery query = read_query(params);
  Overrides& over = query.overrides;
  over.samples = 1;  // which drops the document's contracts
  over.target_rmse.reset();
  over.budget_ms.reset();
  over.precision.reset();
  return query;
}

RenderQuery read_job_query(JobTask task, const httplib::Params& params) {
  return task == JobTask::tradeoff ? read_curve_query(params) : read_query(params);
}

void require_valid_settings(const httplib::Params& params, const Scene& scene) {
  ErrorList errors;  // of rules only: as a document's own samples, they ask for no work
  check_view_rules(with_overrides(scene, read_query(params).overrides), errors);
  if (!errors.empty()) throw HttpError(scene_problem(std::move(errors).take()));
}

void require_room_for_curve(const Scene& scene, const Limits& limits) {
  const double least = work_of(scene, least_curve_samples);
  if (least > static_cast<double>(limits.work))
    refuse_beyond(&Limits::work,
                  fmt::format("a trade-off takes at least {} samples per pixel in all, {} rays for "
                              "this image, but this service accepts {}: ask for fewer pixels",
                              least_curve_samples, least, limits.work));
  if (least_reference_samples > limits.samples)
    refuse_beyond(&Limits::samples,
                  fmt::format("a trade-off compares with an image of at least {} samples per "
                              "pixel, but this service accepts {}",
                              least_reference_samples, limits.samples));
}

CurveText text_of(const Curve& curve) {
  const CurveReference& reference = curve.reference;
  Json points = Json::array();
  Json contract = Json::array();
  for (const CurvePoint& point : curve.points) {
    points.push_back(point_json(point));
    if (point.settings.target_rmse) contract.push_back(contract_json(point));
  }
  const Json json{{"width", curve.width_px},
                  {"height", curve.height_px},
                  {"threads", curve.thread_count},
                  {"reference",
                   {{"settings", settings_json(reference.settings)},
                    {"samples", *reference.settings.samples},
                    {"estimated_error", reference.estimated_error},
                    {"trace_ms", reference.trace_ms}}},
                  {"points", std::move(points)},
                  {"contract", std::move(contract)}};
  return {json.dump(2) + "\n"};
}

}  // namespace raytracer

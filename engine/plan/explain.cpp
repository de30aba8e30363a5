#include "engine/plan/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/plan/health.h"

namespace raytracer {
namespace {

using Json = nlohmann::ordered_json;

Json choice(Json value, const std::string& reason) {
  return {{"choice", std::move(value)}, {"reason", reason}};
}

/// To three digits: what is predicted is not known to more.
double rounded(double value) { return std::stod(fmt::format("{:.3g}", value)); }

const char* name_of(Shadows shadows) {
  switch (shadows) {
    case Shadows::black:
      return "black";
    case Shadows::ambient:
      return "ambient";
    case Shadows::off:
      break;
  }
  return "off";
}

/// "sphere_squares"
std::string key_of(std::string_view noun) {
  std::string key(noun);
  std::replace(key.begin(), key.end(), ' ', '_');
  return key + "s";
}

Json features_json(const Scene& scene, const Features& features) {
  Json objects;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    objects[key_of(Kind::noun)] = features.primitives[kind_index<Kind>];
  });
  Json lights;
  LightKinds::for_each([&]<class Kind>(std::type_identity<Kind>) {
    lights[std::string(Kind::type)] = features.lights[LightKinds::index_of<Kind>()];
  });
  Json shading = Json::array();
  if (features.has_ambient) shading.push_back("ambient");
  if (features.has_diffuse) shading.push_back("diffuse");
  if (features.has_specular) shading.push_back("specular");
  if (features.has_corner_normals) shading.push_back("interpolated normals");
  if (features.has_corner_colors) shading.push_back("interpolated colors");
  Json json{{"objects", objects},
            {"lights", lights},
            {"shadows", features.casts_shadows ? name_of(scene.shadows) : "none"},
            {"materials", features.materials},
            {"shading", shading}};
  if (features.has_specular) {
    json["shininess"] = {{"largest", features.shininess},
                         {"small_integers", features.integer_shininess.are_all}};
  }
  json["reflections"] = features.reflects ? features.max_depth : 0;
  json["refractions"] = features.transmits ? features.max_depth : 0;
  return json;
}

Json kernel_json(const Choice<Kernel>& kernel) {
  return choice(kernel.value == Kernel::packets ? "packets of rays" : "one ray at a time",
                kernel.reason());
}

/// "2 spheres: screen bins from the eye, one by one to the lights; 1 plane: one by one from ..."
std::string summary(const std::vector<FinderExplanation>& rows) {
  std::string text;
  std::string_view objects;
  for (const FinderExplanation& row : rows) {
    if (row.objects == objects)
      text += fmt::format(", {} {}", row.finder, row.rays);
    else
      text +=
          fmt::format("{}{}: {} {}", text.empty() ? "" : "; ", row.objects, row.finder, row.rays);
    objects = row.objects;
  }
  return text;
}

Json geometry_json(const Plan& plan) {
  const std::vector<FinderExplanation> rows =
      explain_finders(plan.features, plan.statistics, plan.kernel.value, plan.finders);
  std::string finders;
  Json list = Json::array();
  for (const FinderExplanation& row : rows) {
    if (finders.find(row.finder) == std::string::npos)
      finders += (finders.empty() ? "" : ", ") + row.finder;
    list.push_back({{"objects", row.objects},
                    {"rays", row.rays},
                    {"choice", row.finder},
                    {"reason", row.reason}});
  }
  Json json =
      rows.empty() ? choice("nothing", "there is nothing to meet") : choice(finders, summary(rows));
  json["finders"] = list;
  return json;
}

Json instruction_set_json(const InstructionSet& set) {
  std::string reason = "the widest vectors that this machine has";
  if (std::string_view(set.name).starts_with("AVX3")) reason = "AVX-512, " + reason;
  return choice(set.name, reason);
}

Json frame_json(const Frame& frame) {
  return choice(
      fmt::format("the eye at the origin, one unit 2^{} of the scene's", frame.exponent()),
      "the farthest thing is then about 1 away, and scaling by a power of two is exact: "
      "a scene of any size, however far off, is traced as well as one at home");
}

Json prediction_json(const Prediction& prediction) {
  return {{"build_ms", rounded(prediction.build_ms)}, {"trace_ms", rounded(prediction.trace_ms)},
          {"threads", prediction.thread_count},       {"samples", prediction.samples},
          {"error", rounded(prediction.error)},       {"time_reason", prediction.basis},
          {"error_reason", prediction.error_basis}};
}

}  // namespace

std::string explain(const Scene& scene, const Plan& plan, const Prediction& prediction) {
  Json json;
  json["features"] = features_json(scene, plan.features);
  json["kernel"] = kernel_json(plan.kernel);
  json["instruction_set"] = instruction_set_json(plan.instruction_set);
  json["precision"] = choice(name_of(plan.precision.value), plan.precision.reason());
  json["precision"]["displacement_px"] = rounded(plan.arithmetic_error.displacement_px);
  json["precision"]["levels"] = rounded(plan.arithmetic_error.levels);
  json["geometry"] = geometry_json(plan);
  json["sampling"] =
      choice(plan.sampling.value == Sampling::contract ? Json("refined")
                                                       : Json(scene.render.samples.value_or(1)),
             plan.sampling.reason());
  if (plan.features.soft_lights > 0)
    json["light_samples"] =
        choice(light_samples_of(plan, first_samples(scene.render, plan.statistics)),
               plan.light_sampling.reason());
  json["tiles"] = choice(plan.tile_side_px.value, plan.tile_side_px.reason());
  json["frame"] = frame_json(plan.frame);
  json["prediction"] = prediction_json(prediction);
  json["health"] = find_strains(scene, plan);
  return json.dump(2) + "\n";
}

}  // namespace raytracer

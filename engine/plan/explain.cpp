#include "engine/plan/explain.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/plan/health.h"

namespace raytracer {
namespace {

using Json = nlohmann::ordered_json;

Json choice(Json value, const std::string& reason) {
  return {{"choice", std::move(value)}, {"reason", reason}};
}

/// To three digits: what is foreseen is not known to more.
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

Json features_json(const Scene& scene, const Features& features) {
  Json shading = Json::array();
  if (features.has_ambient) shading.push_back("ambient");
  if (features.has_diffuse) shading.push_back("diffuse");
  if (features.has_specular) shading.push_back("specular");
  Json json{{"objects",
             {{"spheres", features.spheres},
              {"sphere_squares", features.squares},
              {"planes", features.planes},
              {"triangles", features.triangles}}},
            {"lights", {{"distant", features.distant_lights}, {"point", features.point_lights}}},
            {"shadows", features.casts_shadows ? name_of(scene.shadows) : "none"},
            {"materials", features.materials},
            {"shading", shading}};
  if (features.has_specular) {
    json["shininess"] = {{"largest", features.shininess},
                         {"same_integer_everywhere", features.uniform_shininess >= 0}};
  }
  json["reflections"] = features.max_depth;
  return json;
}

Json kernel_json(const Choice<Kernel>& kernel) {
  return choice(kernel.value == Kernel::simd ? "packets of rays" : "one ray at a time",
                kernel.reason());
}

/// "2 spheres: screen bins from the eye, one by one to the lights; 1 plane: one by one from ..."
std::string summary(const std::vector<Way>& ways) {
  std::string text;
  std::string_view objects;
  for (const Way& way : ways) {
    if (way.objects == objects)
      text += fmt::format(", {} {}", way.structure, way.rays);
    else
      text += fmt::format("{}{}: {} {}", text.empty() ? "" : "; ", way.objects, way.structure,
                          way.rays);
    objects = way.objects;
  }
  return text;
}

Json geometry_json(const Scene& scene, const Plan& plan) {
  const std::vector<Way> ways =
      explain_ways(scene, plan.features, plan.kernel.value, plan.structures);
  std::string structures;
  Json list = Json::array();
  for (const Way& way : ways) {
    if (structures.find(way.structure) == std::string::npos)
      structures += (structures.empty() ? "" : ", ") + way.structure;
    list.push_back({{"objects", way.objects},
                    {"rays", way.rays},
                    {"choice", way.structure},
                    {"reason", way.reason}});
  }
  Json json = ways.empty() ? choice("nothing", "there is nothing to meet")
                           : choice(structures, summary(ways));
  json["ways"] = list;
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
  const bool is_single = plan.precision.value == Precision::single_precision;
  Json json;
  json["features"] = features_json(scene, plan.features);
  json["kernel"] = kernel_json(plan.kernel);
  json["instruction_set"] = instruction_set_json(plan.instruction_set);
  json["precision"] = choice(is_single ? "single" : "double", plan.precision.reason());
  json["precision"]["displacement_px"] = rounded(plan.arithmetic_error.displacement_px);
  json["precision"]["levels"] = rounded(plan.arithmetic_error.levels);
  json["geometry"] = geometry_json(scene, plan);
  json["sampling"] =
      choice(plan.sampling.value == Sampling::contract ? Json("refined")
                                                       : Json(scene.render.samples.value_or(1)),
             plan.sampling.reason());
  json["tiles"] = choice(plan.tile_side_px.value, plan.tile_side_px.reason());
  json["frame"] = frame_json(plan.frame);
  json["prediction"] = prediction_json(prediction);
  json["health"] = find_strains(scene, plan);
  return json.dump(2) + "\n";
}

}  // namespace raytracer

#include "tests/measure/bench/cases.h"

#include <fmt/format.h>

namespace raytracer::bench {

std::string Case::name() const {
  std::string text = scene.name;
  if (view.width) text += fmt::format(", {} x {}", *view.width, *view.height);
  if (view.samples && *view.samples > 1) text += fmt::format(", {} samples", *view.samples);
  return text;
}

std::vector<Case> standard_cases(const std::string& shipped) {
  struct Row {
    const char* scene;
    bool is_quick;
    bool is_also_large;
    bool has_also_samples;
  };
  constexpr Row rows[] = {
      {"two-spheres", true, true, true},        {"square-28x28", true, true, true},
      {"square-500x500", false, true, true},    {"spheres-500x500", false, false, true},
      {"random-1000", true, true, true},        {"random-100000", false, true, false},
      {"random-1000000", false, false, false},  {"sphereflake-7381", true, true, true},
      {"mesh-100000", false, true, false},      {"reflections", true, true, true},
      {"haines-balls", false, false, false},    {"haines-mount", false, false, false},
      {"haines-rings", false, false, false},    {"haines-tree", false, false, false},
      {"haines-goblet", false, false, false},   {"haines-gears", false, false, false},
      {"haines-tetra", false, false, false},    {"haines-shells", false, false, false},
      {"spheres", false, false, false},         {"mirrors", false, false, false},
      {"glass", false, false, false},           {"still-life", false, false, false},
      {"sky-1000", false, false, false},        {"sky-100000", false, false, false},
      {"sky-sphereflake", false, false, false}, {"ground", false, false, false},
      {"sky-ground", false, false, false},
  };
  Overrides one_sample;  // the shipped ones ask for more
  one_sample.samples = 1;
  Overrides samples;
  samples.samples = 16;
  Overrides large;
  large.width = 3840;
  large.height = 2160;
  std::vector<Case> cases;
  const auto add = [&](bool Row::*is_wanted, const Overrides& view) {
    for (const Row& row : rows)
      if (!is_wanted || row.*is_wanted)
        cases.push_back(
            {measure::find_scene(row.scene, shipped), view, row.is_quick && !is_wanted});
  };
  add(nullptr, one_sample);
  add(&Row::has_also_samples, samples);
  add(&Row::is_also_large, large);
  return cases;
}

}  // namespace raytracer::bench

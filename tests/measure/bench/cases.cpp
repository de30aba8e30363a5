#include "tests/measure/bench/cases.h"

#include <fmt/format.h>

#include "tests/measure/scenes/scene_documents.h"

namespace raytracer::bench {
namespace {

std::string square_28() { return two_spheres_and_square(14); }
std::string square_500() { return two_spheres_and_square(250); }
std::string explicit_500() { return two_spheres_and_explicit_square(250); }
std::string random_1000() { return random_spheres(1'000); }
std::string random_100000() { return random_spheres(100'000); }
std::string random_1000000() { return random_spheres(1'000'000); }
std::string flake_7381() { return sphereflake(4); }
std::string torus_100000() { return bumpy_torus(250, 200); }

}  // namespace

std::string Case::name() const {
  std::string text = scene;
  if (width != 700 || height != 500) text += fmt::format(", {} x {}", width, height);
  if (samples != 1) text += fmt::format(", {} samples", samples);
  return text;
}

std::vector<Case> all_cases() {
  struct Row {
    const char* scene;
    std::string (*document)();
    bool is_quick;
    bool is_also_large;
    bool has_also_samples;
  };
  const std::vector<Row> rows{
      {"two-spheres", two_spheres, true, true, true},
      {"square-28", square_28, true, true, true},
      {"square-500", square_500, false, true, true},
      {"explicit-500", explicit_500, false, false, true},
      {"random-1000", random_1000, true, true, true},
      {"random-100000", random_100000, false, true, false},
      {"random-1000000", random_1000000, false, false, false},
      {"sphereflake", flake_7381, true, true, true},
      {"mesh-100000", torus_100000, false, true, false},
      {"reflections", reflections, true, true, true},
  };
  std::vector<Case> cases;
  cases.reserve(3 * rows.size());
  for (const Row& row : rows)
    cases.push_back({.scene = row.scene, .document = row.document, .is_quick = row.is_quick});
  for (const Row& row : rows)
    if (row.has_also_samples)
      cases.push_back({.scene = row.scene, .document = row.document, .samples = 16});
  for (const Row& row : rows)
    if (row.is_also_large)
      cases.push_back(
          {.scene = row.scene, .document = row.document, .width = 3840, .height = 2160});
  return cases;
}

}  // namespace raytracer::bench

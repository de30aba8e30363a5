#include "tests/measure/scenes/named_scene.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "tests/measure/scenes/ground_scenes.h"
#include "tests/measure/scenes/haines_scenes.h"
#include "tests/measure/scenes/scene_documents.h"

namespace raytracer::measure {
namespace {

namespace fs = std::filesystem;

NamedScene in_file(const fs::path& path) {
  return {path.stem().string(), [path] {
            std::ifstream file(path, std::ios::binary);
            std::string text{std::istreambuf_iterator<char>(file), {}};
            if (!file) throw std::runtime_error("cannot read " + path.string());
            return text;
          }};
}

}  // namespace

std::vector<NamedScene> made_scenes() {
  return {{"two-spheres", two_spheres},
          {"square-28x28", [] { return two_spheres_and_square(14); }},
          {"square-80x80", [] { return two_spheres_and_square(40); }},
          {"square-500x500", [] { return two_spheres_and_square(250); }},
          {"spheres-500x500", [] { return two_spheres_and_explicit_square(250); }},
          {"random-1000", [] { return random_spheres(1'000); }},
          {"random-100000", [] { return random_spheres(100'000); }},
          {"random-1000000", [] { return random_spheres(1'000'000); }},
          {"sphereflake-7381", [] { return sphereflake(4); }},
          {"mesh-4800", [] { return bumpy_torus(60, 40); }},
          {"mesh-100000", [] { return bumpy_torus(250, 200); }},
          {"reflections", reflections},
          {"sky-1000", [] { return random_spheres_under_sky(1'000); }},
          {"sky-100000", [] { return random_spheres_under_sky(100'000); }},
          {"sky-sphereflake", [] { return sphereflake_under_sky(4); }},
          {"wide-sun-1000", [] { return random_spheres_under_wide_sun(1'000); }},
          {"wide-sun-100000", [] { return random_spheres_under_wide_sun(100'000); }},
          {"lamp-1000", [] { return random_spheres_under_lamp(1'000); }},
          {"ground", balls_on_ground_sphere},
          {"sky-ground", balls_on_ground_sphere_under_sky},
          {"haines-balls", haines_balls},
          {"haines-mount", haines_mount},
          {"haines-rings", haines_rings},
          {"haines-tree", haines_tree},
          {"haines-goblet", haines_goblet},
          {"haines-gears", haines_gears},
          {"haines-tetra", haines_tetra},
          {"haines-shells", haines_shells}};
}

std::vector<NamedScene> shipped_scenes(const std::string& shipped) {
  std::vector<NamedScene> scenes;
  for (const auto& entry : fs::directory_iterator(shipped))
    if (entry.path().extension() == ".json") scenes.push_back(in_file(entry.path()));
  std::sort(scenes.begin(), scenes.end(),
            [](const NamedScene& a, const NamedScene& b) { return a.name < b.name; });
  return scenes;
}

NamedScene find_scene(const std::string& name, const std::string& shipped) {
  for (NamedScene& made : made_scenes())
    if (made.name == name) return std::move(made);
  const fs::path of_that_name = fs::path(shipped) / (name + ".json");
  for (const fs::path& path : {of_that_name, fs::path(name)})
    if (fs::is_regular_file(path)) return in_file(path);
  throw std::runtime_error(name + ": no scene that is made here, none in " + shipped +
                           " and no file");
}

Scene read_document(std::string_view document, const Overrides& overrides) {
  Result<Scene> scene = read_scene(document, Limits{}, overrides);
  if (!scene.ok()) {
    const auto& error = scene.errors()[0];
    throw std::runtime_error((error.pointer.empty() ? "the document" : error.pointer) + ": " +
                             error.detail);
  }
  return std::move(scene).value();
}

}  // namespace raytracer::measure

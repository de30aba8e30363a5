#include "tests/variants/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "engine/scene/read_scene.h"
#include "tests/variants/random_documents.h"

namespace raytracer::test {
namespace {

constexpr int width_px = 160;

/// A flat sheet before a plane, wider than the view, whose sides and corners the rays and the
/// shadows pass through: wherever one slips between triangles it shows.
Scene straight_sheet() {
  std::string vertices;
  std::string triangles;
  constexpr int side = 96;
  constexpr double middle = side / 16.0;
  for (int i = 0; i <= side; ++i)
    for (int k = 0; k <= side; ++k)
      vertices += fmt::format("{}[{}, {}, 0]", vertices.empty() ? "" : ",", i / 8.0 - middle,
                              k / 8.0 - middle);
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const int a = i * (side + 1) + k;
      const int b = a + side + 1;
      triangles += fmt::format("{}[{},{},{}],[{},{},{}]", triangles.empty() ? "" : ",", a, b, b + 1,
                               b + 1, a + 1, a);
    }
  }
  const std::string mesh = fmt::format(
      R"({{"type": "mesh", "vertices": [{}], "triangles": [{}], "material": {{"color": [1, 0, 0]}}}})",
      vertices, triangles);
  const std::string wall = R"({"type": "plane", "point": [0, 0, 1], "normal": [0, 0, 1]})";
  Scene scene = with_objects(mesh + "," + wall, R"({"type": "distant", "direction": [0, 0, 1]})");
  scene.camera.origin = {0, 0, -8};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.fov = 2 * std::atan(0.625);  // pixels are 1/16 wide on the sheet
  scene.camera.height = scene.camera.width;
  scene.camera.origin.x += 1.0 / 32;  // and their centres on corners of the triangles
  scene.camera.origin.y += 1.0 / 32;
  scene.camera.look_at = {1.0 / 32, 1.0 / 32, 0};
  return scene;
}

/// A small open cone from near by, under a light that is a hundred times as far off as it is wide.
Scene open_cone() {
  const std::string cone =
      R"({"type": "cone", "from": [-2.900497, 1.765998, 0.056951], "radius_from": 0.146451,
          "to": [-2.870479, 1.786373, 0.16314], "radius_to": 0.010944, "caps": false})";
  const std::string ball = R"({"type": "sphere", "center": [3, 0.8, -1], "radius": 1.4})";
  Scene scene = with_objects(cone + "," + ball,
                             R"({"type": "point", "position": [5.718956, 6.061917, 3.830749],
                                 "intensity": 0.5, "falloff": "none"})");
  scene.camera.origin = {5, 0, 3};
  scene.camera.look_at = {-2.885, 1.776, 0.11};
  scene.camera.fov = 0.02;
  return scene;
}

/// Where each pixel takes many rays.
Scene small(Scene scene) {
  scene.camera.width = 48;
  scene.camera.height = 36;
  return scene;
}

}  // namespace

Scene prepared(const std::string& text) {
  Overrides overrides;
  overrides.samples = 1;
  overrides.transfer = Transfer::linear;
  Scene scene = read_scene(text, Limits{}, overrides).value();
  scene.camera.height = std::max(1, scene.camera.height * width_px / scene.camera.width);
  scene.camera.width = width_px;
  return scene;
}

Scene with_objects(const std::string& objects, const std::string& lights) {
  return prepared(fmt::format(
      R"({{"camera": {{"origin": [0, 3, -12], "look_at": [0, 0, 0], "fov": 0.9, "width": 160,
          "height": 120}}, "background": [0.2, 0.3, 0.4], "lights": [{}], "objects": [{}]}})",
      lights, objects));
}

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES_DIRECTORY)) {
    std::ifstream file(entry.path(), std::ios::binary);
    Scene scene = prepared({std::istreambuf_iterator<char>(file), {}});
    if (std::any_of(scene.lights.begin(), scene.lights.end(), is_soft)) scene = small(scene);
    scenes.push_back({entry.path().stem().string(), scene});
  }
  const std::string matt = R"({"shininess": 20})";
  const std::string mirror = R"({"reflectivity": 0.6})";
  const std::string floor = R"({"type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0]})";
  const std::string square =
      R"({"type": "sphere_square", "center": [0, -2, 0], "radius": 0.3, "n": 9, "axes": ")";
  scenes.push_back({"few spheres, point light",
                    with_objects(random_spheres(9, 0.8, matt) + "," + floor, point_light)});
  scenes.push_back({"many spheres, distant lights",
                    with_objects(random_spheres(900, 0.3, matt) + "," + floor, distant_lights)});
  scenes.push_back(
      {"many spheres, point light", with_objects(random_spheres(900, 0.3, matt), point_light)});
  scenes.push_back({"many mirrors",
                    with_objects(random_spheres(400, 0.4, mirror) + "," + floor, distant_lights)});
  for (const std::string& lights : {std::string(distant_lights), std::string(point_light),
                                    std::string(distant_lights) + "," + point_light}) {
    const std::string under =
        " under " + std::to_string(std::count(lights.begin(), lights.end(), '{')) + " lights";
    scenes.push_back({"sheet" + under, with_objects(rough_sheet(70, matt) + "," + floor, lights)});
    for (const int side : {12, 41})
      scenes.push_back(
          {"smooth sheet" + under, with_objects(smooth_sheet(side, matt) + "," + floor + "," +
                                                    random_spheres(20, 0.3, mirror),
                                                lights)});
    scenes.push_back(
        {"smooth mirror" + under,
         with_objects(smooth_sheet(8, mirror) + "," + random_spheres(20, 0.3, matt), lights)});
    scenes.push_back(
        {"mirroring sheet" + under,
         with_objects(rough_sheet(9, mirror) + "," + random_spheres(200, 0.3, mirror), lights)});
    scenes.push_back(
        {"large triangles" + under,
         with_objects(random_triangles(90, matt) + "," + random_spheres(40, 0.3, matt), lights)});
  }
  for (const std::string& lights : {std::string(distant_lights), std::string(point_light),
                                    std::string(distant_lights) + "," + point_light}) {
    const std::string under =
        " under " + std::to_string(std::count(lights.begin(), lights.end(), '{')) + " lights";
    for (const int count : {6, 90, 1500})
      for (const std::string& material : {matt, mirror}) {
        const std::string others = "," + floor + "," + random_spheres(20, 0.3, mirror);
        const auto add = [&](const char* kind, const std::string& objects) {
          scenes.push_back({fmt::format("{}{}{} of {}", count, kind, under, material),
                            with_objects(objects + others, lights)});
        };
        add(" cylinders", random_cylinders(count, material));
        add(" cones", random_cones(count, material));
      }
  }
  const std::string sky = R"({"type": "sky", "color": [0.7, 0.8, 1], "intensity": 0.6})";
  const std::string near_sky = R"({"type": "sky", "intensity": 0.6, "reach": 1.5})";
  const std::string sun = R"({"type": "distant", "direction": [-1, -2, 1.5], "angle": 0.3})";
  const std::string lamp =
      R"({"type": "point", "position": [4, 6, -5], "radius": 1, "intensity": 500})";
  const std::string glass = R"({"transparency": 0.7, "fresnel": true})";
  const std::string flat =
      R"({"type": "cone", "from": [0, 1, -5], "to": [0, 1.04, -4.9], "radius_from": 3,
          "radius_to": 0, "material": )" +
      glass + "}";
  scenes.push_back({"glass around axes",
                    with_objects(random_cylinders(40, glass) + "," + random_cones(60, glass) + "," +
                                     flat + "," + floor + "," + random_spheres(20, 0.3, mirror),
                                 std::string(distant_lights) + "," + point_light)});
  for (const auto& [light, material] :
       {std::pair(sky, matt), std::pair(near_sky, glass), std::pair(sun, mirror),
        std::pair(lamp, matt), std::pair(lamp, glass),
        std::pair(fmt::format("{},{}", sky, sun), glass)})
    scenes.push_back(
        {fmt::format("soft light {} on {}", light, material),
         small(with_objects(random_spheres(60, 0.6, material) + "," + random_cylinders(4, matt) +
                                "," + random_cones(4, matt) + "," + smooth_sheet(4, matt) + "," +
                                floor,
                            light))});
  scenes.push_back(
      {"square under a sky", small(with_objects(square + "xz\"}," + floor, sky + "," + sun))});
  // With spheres inside of its own and across them.
  for (const std::string& lights :
       {std::string(distant_lights) + "," + point_light, sky + "," + lamp})
    scenes.push_back({"glass square under " + lights,
                      small(with_objects(square + "xz\", \"material\": " + glass + "}," + square +
                                             "xy\", \"material\": " + glass + "}," +
                                             R"({"type": "spheres", "radius": [0.12, 0.2, 0.4],
                                    "centers": [[0.3, -2, 0.3], [0.9, -1.95, -0.9], [-0.6, -2, -1]],
                                    "material": )" +
                                             glass + "}," + floor,
                                         lights))});
  scenes.push_back(
      {"endless glass square",
       with_objects(R"({"type": "sphere_square", "center": [0.3, -2, 0.1], "radius": 0.3,
                                     "n": 1000000000, "axes": "xz", "material": )" +
                        glass + "}",
                    distant_lights)});
  scenes.push_back({"sheet seen along its corners", straight_sheet()});
  scenes.push_back({"open cone", open_cone()});
  for (const std::string axes : {"xz", "xy", "yz"})
    scenes.push_back(
        {"square " + axes,
         with_objects(square + axes + "\"}," + random_spheres(2, 0.7, mirror), distant_lights)});
  scenes.push_back({"square, point light",
                    with_objects(square + "xz\"}," + random_spheres(2, 0.7, matt), point_light)});
  scenes.push_back(
      {"square, low light",
       with_objects(square + "xz\"}", R"({"type": "distant", "direction": [-1, -0.04, 0.7]})")});
  return scenes;
}

}  // namespace raytracer::test

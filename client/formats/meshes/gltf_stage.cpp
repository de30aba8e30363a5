#include "client/formats/meshes/gltf_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "client/formats/numbers.h"
#include "client/formats/triple.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

using model::Triple;
using nlohmann::json;

/// Where something stands, and where its axes go.
struct Placement {
  std::array<Triple, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Triple origin{};

  Triple direction(const Triple& own) const {
    return sum(sum(scaled(axes[0], own[0]), scaled(axes[1], own[1])), scaled(axes[2], own[2]));
  }
  /// Of what stands at `own` in this.
  Placement of(const Placement& own) const {
    return {{direction(own.axes[0]), direction(own.axes[1]), direction(own.axes[2])},
            sum(origin, direction(own.origin))};
  }
};

/// A node's, in its parent. A matrix is written by columns; a quaternion ends with its real part.
Placement placement_of(const json& node) {
  if (const auto matrix = node.find("matrix"); matrix != node.end()) {
    const auto m = matrix->get<std::array<double, 16>>();
    return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
  }
  const auto [x, y, z, w] = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
  const Triple scale = node.value("scale", Triple{1, 1, 1});
  return {{scaled({1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)}, scale[0]),
           scaled({2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, scale[1]),
           scaled({2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}, scale[2])},
          node.value("translation", Triple{})};
}

bool is_place(const Triple& all) { return std::all_of(all.begin(), all.end(), is_moderate); }

bool is_direction(const Triple& all) {
  return is_place(all) && std::any_of(all.begin(), all.end(), [](double one) { return one != 0; });
}

bool are_parallel(const Triple& a, const Triple& b) {
  constexpr double small = 1e-9;  // the sine of their angle
  const Triple across = cross(unit(a), unit(b));
  return dot(across, across) < small * small;
}

class GltfStage {
 public:
  GltfStage(const json& file, Reading& reading) : file_(file), reading_(reading) {
    if (const auto extensions = file.find("extensions"); extensions != file.end())
      if (const auto found = extensions->find(lights_name); found != extensions->end())
        lights_ = found->at("lights");
  }

  void read() {
    const auto scenes = file_.find("scenes");
    if (scenes == file_.end() || !file_.contains("nodes")) return;
    was_seen_.resize(file_.at("nodes").size());
    for (const std::size_t root : scenes->at(file_.value("scene", std::size_t{0}))
                                      .value("nodes", std::vector<std::size_t>()))
      add_node(root, {});
  }

 private:
  static constexpr const char* lights_name = "KHR_lights_punctual";

  /// Of a file that is right each node has one parent at most.
  void add_node(std::size_t index, const Placement& parent) {
    const json& node = file_.at("nodes").at(index);
    if (was_seen_.at(index)) return;
    was_seen_[index] = true;
    const Placement placement = parent.of(placement_of(node));
    if (const auto camera = node.find("camera"); camera != node.end())
      add_camera(file_.at("cameras").at(camera->get<std::size_t>()), placement);
    if (const auto extensions = node.find("extensions"); extensions != node.end())
      if (const auto light = extensions->find(lights_name); light != extensions->end())
        add_light(lights_.at(light->at("light").get<std::size_t>()), placement);
    for (const std::size_t child : node.value("children", std::vector<std::size_t>()))
      add_node(child, placement);
  }

  /// It looks along its -z, with y upward.
  void add_camera(const json& camera, const Placement& placement) {
    const model::Camera placed{placement.origin, scaled(placement.axes[2], -1), placement.axes[1],
                               camera.value("/perspective/yfov"_json_pointer, 0.0)};
    const bool is_one = placed.fov > 0 && placed.fov < std::numbers::pi && is_place(placed.from) &&
                        is_direction(placed.ahead) && is_direction(placed.up) &&
                        !are_parallel(placed.ahead, placed.up);
    if (is_one && !reading_.scene.camera)
      reading_.scene.camera = placed;
    else
      reading_.omit(0, "camera left out", "cameras left out");
  }

  /// It shines along its -z.
  void add_light(const json& light, const Placement& placement) {
    Triple color = light.value("color", Triple{1, 1, 1});
    for (double& share : color) share = std::clamp(share, 0.0, 1.0);
    const double intensity = light.value("intensity", 1.0);
    const std::string type = light.at("type");
    const Triple direction = scaled(placement.axes[2], -1);
    const bool is_sun = type == "directional";
    const bool is_out = intensity == 0 || color == Triple{};
    if (is_out) return;
    if (!(intensity >= 0 && is_moderate(intensity)) ||
        !(is_sun ? is_direction(direction) : is_place(placement.origin)))
      return reading_.omit(0, "light left out", "lights left out");
    if (is_sun)
      reading_.scene.lights.emplace_back(model::Sun{direction, color, intensity});
    else
      reading_.scene.lights.emplace_back(model::Lamp{
          placement.origin, color, 4 * std::numbers::pi * intensity, /*falls_off=*/true});
    if (type == "spot")
      reading_.omit(0, "spot light shines to all sides", "spot lights shine to all sides");
  }

  const json& file_;
  Reading& reading_;
  json lights_;
  std::vector<bool> was_seen_;
};

}  // namespace

void read_gltf_stage(std::string_view text, Reading& reading) {
  try {
    const json file = json::parse(without_byte_order_mark(text));
    if (file.at("asset").at("version").get<std::string>().starts_with('2'))
      GltfStage(file, reading).read();
  } catch (const json::exception&) {
    // Assimp has shown what it can of the file.
    reading.omit(0, "camera or light that cannot be read left out, with all that follow",
                 "cameras or lights that cannot be read left out");
  }
}

}  // namespace raytracer::client

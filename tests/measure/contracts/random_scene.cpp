#include "tests/measure/contracts/random_scene.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "tests/measure/contracts/random_objects.h"

namespace raytracer::published {
namespace {

using nlohmann::json;

/// An element of a list, each as often as the others.
template <typename List>
const auto& one_of(Dice& dice, const List& list) {
  return list[static_cast<std::size_t>(dice.count(0, static_cast<int>(list.size()) - 1))];
}

Vec3 vec_of(const json& point) {
  return {point[0].get<double>(), point[1].get<double>(), point[2].get<double>()};
}

json color(Dice& dice) { return json_of(dice.point(0.5) + Vec3{0.5, 0.5, 0.5}); }

/// Between both, horizontal to steep.
Vec3 upward(Dice& dice, double least_elevation, double most_elevation) {
  const double turn = dice.within(0, 2 * std::numbers::pi);
  const double elevation = dice.within(least_elevation, most_elevation);
  return {std::cos(elevation) * std::cos(turn), std::sin(elevation),
          std::cos(elevation) * std::sin(turn)};
}

/// Outside most of what is in the cube, looking at something near its middle.
json camera(Dice& dice, double half) {
  const Vec3 target = dice.point(0.4 * half);
  const double distance = half * dice.of_any_size(1.3, 5);
  const int width = dice.count_of_any_size(32, 320);
  const double aspect = dice.within(0.5, 1.2);
  const double zoom = dice.within(0.6, 1.3);
  json camera{{"origin", json_of(target + distance * upward(dice, -0.1, 1.2))},
              {"look_at", json_of(target)},
              {"fov", json_of(2 * std::atan(zoom * half / distance))},
              {"width", width},
              {"height", static_cast<int>(std::lround(width * aspect))}};
  if (dice.happens(0.2)) camera["up"] = json_of(Vec3{0, 1, 0} + dice.point(0.4));
  return camera;
}

/// One of `count` lights that are together about as bright as a sun.
json light(Dice& dice, double half, int count) {
  const double strength = dice.within(0.4, 1.2) / std::sqrt(count);
  const bool is_distant = dice.happens(0.5);
  const Vec3 from = upward(dice, 0.15, 1.5);
  const double distance = half * dice.within(1.2, 3);
  json light =
      is_distant
          ? json{{"type", "distant"},
                 {"direction", json_of(-from)},
                 {"intensity", json_of(strength)}}
          : json{{"type", "point"},
                 {"position", json_of(distance * from)},
                 {"intensity", json_of(strength * 4 * std::numbers::pi * distance * distance)}};
  if (!is_distant && dice.happens(0.2)) {
    light["falloff"] = "none";
    light["intensity"] = json_of(strength);
  }
  if (dice.happens(0.15)) {
    if (is_distant)
      light["angle"] = json_of(dice.of_any_size(0.01, 1));
    else
      light["radius"] = json_of(distance * dice.of_any_size(0.01, 0.3));
  } else if (dice.happens(0.15)) {
    light = {{"type", "sky"}, {"intensity", json_of(strength)}};
    if (dice.happens(0.3)) light["reach"] = json_of(half * dice.of_any_size(0.1, 2));
  }
  if (dice.happens(0.6)) light["color"] = json_of(Vec3{0.75, 0.75, 0.75} + dice.point(0.25));
  return light;
}

/// What some materials of a scene may do with rays.
struct Effects {
  bool mirrors;
  bool glass;
};

json material(Dice& dice, const Effects& effects) {
  json material{{"color", color(dice)}};
  if (dice.happens(0.5)) material["ka"] = json_of(dice.within(0, 1));
  if (dice.happens(0.8)) material["kd"] = json_of(dice.within(0.2, 1));
  material["ks"] = dice.happens(0.6) ? json_of(dice.within(0.1, 1)) : json(0);
  material["shininess"] = json_of(dice.of_any_size(1, 500));
  if (effects.mirrors && dice.happens(0.5))
    material["reflectivity"] = json_of(dice.within(0.05, 0.9));
  if (effects.glass && dice.happens(0.5)) {
    material["transparency"] = json_of(dice.within(0.2, 1));
    material["ior"] = json_of(dice.within(1, 2));
    material["fresnel"] = dice.happens(0.5);
  }
  return material;
}

json materials(Dice& dice, const Effects& effects) {
  constexpr std::array names{"first", "second", "third", "fourth"};
  json materials = json::object();
  const int count = dice.count(1, static_cast<int>(names.size()));
  for (int i = 0; i < count; ++i)
    materials[names[static_cast<std::size_t>(i)]] = material(dice, effects);
  return materials;
}

/// By name, in place, or the default.
void give_material(Dice& dice, const json& named, const Effects& effects, json& object) {
  const auto index = dice.count(0, static_cast<int>(named.size()) - 1);
  if (dice.happens(0.85))
    object["material"] = std::next(named.begin(), index).key();
  else if (dice.happens(0.7))
    object["material"] = material(dice, effects);
}

/// A second plane adds little, and one between the eye and the cube's middle hides the rest.
bool is_wanted(const json& object, const json& others, const Vec3& eye) {
  if (object["type"] != "plane") return true;
  for (const json& other : others)
    if (other["type"] == "plane") return false;
  const Vec3 normal = vec_of(object["normal"]);
  const Vec3 point = vec_of(object["point"]);
  return dot(eye - point, normal) * dot(-point, normal) > 0;
}

bool says(const json& document, const char* field) {
  return document.dump().find(field) != std::string::npos;
}

}  // namespace

RandomScene random_scene(std::uint64_t seed) {
  Dice dice(seed);
  const double half = dice.of_any_size(1, 30);
  const Effects effects{dice.happens(0.4), dice.happens(0.25)};
  json document;
  document["camera"] = camera(dice, half);
  document["background"] = dice.happens(0.2) ? json::array({0, 0, 0}) : color(dice);
  document["ambient"] = json_of(dice.within(0, 0.4));
  document["shadows"] = one_of(dice, std::array{"black", "ambient", "off"});
  const int light_count = dice.count(1, 5);
  for (int i = 0; i < light_count; ++i)
    document["lights"].push_back(light(dice, half, light_count));
  const json named = materials(dice, effects);
  document["materials"] = named;
  const auto object_count = static_cast<std::size_t>(dice.count(1, 5));
  const Vec3 eye = vec_of(document["camera"]["origin"]);
  json& objects = document["objects"] = json::array();
  std::string words;
  while (objects.size() < object_count) {
    RandomObject drawn = one_of(dice, object_kinds()).draw(dice, half);
    if (!is_wanted(drawn.object, objects, eye)) continue;
    give_material(dice, named, effects, drawn.object);
    objects.push_back(std::move(drawn.object));
    words += (words.empty() ? "" : ", ") + drawn.words;
  }
  document["render"]["transfer"] = one_of(dice, std::array{"linear", "srgb"});
  if (dice.happens(0.5)) document["render"]["max_depth"] = dice.count(1, 6);

  const json& view = document["camera"];
  std::string summary = fmt::format(
      "{} x {}: {}; {} light{}, shadows {}, {}{}{}", view["width"].get<int>(),
      view["height"].get<int>(), words, light_count, light_count == 1 ? "" : "s",
      document["shadows"].get<std::string>(), document["render"]["transfer"].get<std::string>(),
      says(document, "reflectivity") ? ", mirrors" : "",
      says(document, "transparency") ? ", glass" : "");
  document["name"] = fmt::format("Random scene {}", seed);
  document["description"] = summary;
  return {document.dump() + '\n', std::move(summary)};
}

}  // namespace raytracer::published

// A scene with a bit of everything, and what can be done to it without changing its picture.
#pragma once

#include <functional>

#include "tests/support/rays.h"
#include "tests/support/scenes.h"

namespace raytracer::test {

/// Every kind of object, light and material; no two surfaces coincide. 64 x 48 pixels, whose
/// centres are exact in binary. All coordinates are multiples of 1/64.
inline json varied_scene() {
  const json red = {{"color", {0.9, 0.2, 0.1}}, {"kd", 0.5}, {"ks", 0.25}};
  const json mirror = {{"color", {0.2, 0.3, 0.4}}, {"reflectivity", 0.5}, {"shininess", 200}};
  json text = document(
      camera_json(64, 48, 1.1, {0.25, 3, -8}, {0, 0.5, 0}),
      {plane_json({0, -1, 0}, {0, 1, 0}, {{"color", {0.5, 0.6, 0.7}}, {"reflectivity", 0.125}}),
       sphere_json({-1.5, 0.75, 0.25}, 1.25, red), sphere_json({1.75, 0.5, 1}, 1.5, mirror),
       square_json({0, -0.75, 0}, 0.1875, 7, "xz", {{"color", "#4080c0"}}),
       mesh_json({{-3, -0.5, 3}, {3, -0.25, 3.5}, {0.25, 4, 4}, {-2.5, 2, -1}},
                 {{0, 1, 2}, {0, 3, 2}}, {{"color", {0.3, 0.9, 0.4}}}),
       json{{"type", "spheres"},
            {"centers", {{0.25, 0.5, -2}, {0.75, 0.25, -2.5}, {-0.5, 2, -1}, {0.125, 1.5, -1.75}}},
            {"radius", {0.25, 0.125, 0.375, 0.1875}},
            {"material", red}},
       cylinder_json({2.5, -0.75, -1.5}, {3.125, 1.25, -1}, 0.375, true, mirror),
       cylinder_json({-2.25, -0.5, -2.5}, {-1.375, 0.75, -3}, 0.3125, false,
                     {{"color", {0.9, 0.8, 0.2}}}),
       json{{"type", "cylinders"},
            {"from", {{-0.5, -0.75, -3}, {0.5, -0.5, -3.25}, {1.25, 2.5, 0}}},
            {"to", {{-0.25, 0.25, -2.75}, {1.5, -0.25, -2.75}, {1.75, 3.125, -0.5}}},
            {"radius", {0.125, 0.1875, 0.25}},
            {"colors", {{0.25, 0.5, 1}, {1, 0.5, 0.25}, {0.75, 0.25, 0.5}}},
            {"material", {{"reflectivity", 0.25}}}}},
      {distant_json({-0.6, -1, 0.7}, 0.4, {1, 0.9, 0.8}), point_json({2.5, 5, -4}, 200),
       point_json({-4, 2.5, -3}, 100, {0.5, 0.75, 1})});
  text["background"] = {0.5, 0.75, 0.875};
  text["ambient"] = 0.125;
  return text;
}

/// More small spheres than a plan leaves without a tree, out of the picture's way.
inline json filler() {
  json centers = json::array();
  for (int i = 0; i < 40; ++i) centers.push_back({i % 8 - 4, 30, -20 - i / 8});
  return {{"type", "spheres"}, {"centers", centers}, {"radius", 0.25}};
}

/// What a change does to points, directions and lengths.
struct Change {
  std::function<Vec3(const Vec3&)> point = [](const Vec3& p) { return p; };
  std::function<Vec3(const Vec3&)> direction = [](const Vec3& d) { return d; };
  double length = 1;
};

inline Vec3 vector_of(const json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

/// The document with everything in it changed alike; light from points keeps its effect.
inline json changed(json text, const Change& change) {
  const auto apply = [](json& object, const char* key, const auto& function) {
    if (object.contains(key)) object[key] = vector_json(function(vector_of(object[key])));
  };
  json& camera = text["camera"];
  apply(camera, "origin", change.point);
  apply(camera, "look_at", change.point);
  apply(camera, "up", change.direction);
  for (json& light : text["lights"]) {
    apply(light, "direction", change.direction);
    apply(light, "position", change.point);
    if (light["type"] == "point")
      light["intensity"] = light["intensity"].get<double>() * change.length * change.length;
  }
  for (json& object : text["objects"]) {
    apply(object, "normal", change.direction);
    for (const char* key : {"center", "centers", "point", "vertices", "from", "to"}) {
      if (!object.contains(key)) continue;
      json& value = object[key];
      if (value[0].is_array())
        for (json& point : value) point = vector_json(change.point(vector_of(point)));
      else
        value = vector_json(change.point(vector_of(value)));
    }
    if (!object.contains("radius")) continue;
    json& radius = object["radius"];
    if (radius.is_array())
      for (json& one : radius) one = one.get<double>() * change.length;
    else
      radius = radius.get<double>() * change.length;
  }
  return text;
}

inline Change scaling(double factor) {
  return {.point = [factor](const Vec3& p) { return factor * p; }, .length = factor};
}

}  // namespace raytracer::test

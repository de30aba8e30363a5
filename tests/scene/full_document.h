// A valid document that uses every key, and ways to change it.
#pragma once

#include <string>

#include "tests/support/scenes.h"

namespace raytracer::test {

/// A valid document in which every key of the format occurs.
inline json full_document() {
  return json::parse(R"({
    "name": "full", "description": "every key", "$schema": "scene.json",
    "camera": {"origin": [0, 8, -20], "look_at": [0, -1, 0], "up": [0, 1, 0], "fov": 1.0,
               "width": 70, "height": 50},
    "background": [0.53, 0.8, 0.92], "ambient": 0.2, "shadows": "black",
    "lights": [
      {"type": "distant", "direction": [-0.6, -1, 0.7], "color": [1, 1, 1], "intensity": 0.9,
       "angle": 0},
      {"type": "point", "position": [0, 10, 0], "color": "#ffeedd", "intensity": 1500,
       "falloff": "inverse_square", "radius": 0},
      {"type": "sky", "color": [0.5, 0.6, 0.7], "intensity": 0.3, "reach": 4}],
    "materials": {"red": {"color": [0.9, 0.2, 0.2], "ka": 1, "kd": 0.7, "ks": 0.3,
                          "shininess": 50, "reflectivity": 0, "transparency": 0, "ior": 1.5,
                          "fresnel": false}},
    "objects": [
      {"type": "sphere", "center": [-2.5, 0, 0], "radius": 2, "material": "red"},
      {"type": "spheres", "centers": [[0, 0, 0], [1, 0, 0]], "radius": [0.1, 0.2],
       "colors": [[1, 0.5, 0], "#00ff00"], "material": "red"},
      {"type": "sphere_square", "center": [0, -3, 0], "radius": 0.5, "n": 14, "axes": "xz",
       "material": "red"},
      {"type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0]},
      {"type": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]],
       "normals": [[0, 0, 1], [0.5, 0, 2], [0, 0, 3]],
       "colors": ["#102030", [0, 1, 0.5], [1, 1, 1]], "material": {"color": "#102030"}},
      {"type": "cylinder", "from": [0, 0, 0], "to": [0, 3, 0], "radius": 0.5, "caps": true,
       "material": {}},
      {"type": "cylinders", "from": [[0, 0, 0], [1, 0, 0]], "to": [[0, 1, 0], [1, 2, 0]],
       "radius": [0.1, 0.2], "caps": false, "colors": ["#102030", [0, 1, 0.5]]},
      {"type": "cone", "from": [0, 0, 0], "to": [0, 3, 0], "radius_from": 0.5, "radius_to": 0,
       "caps": true, "material": {}},
      {"type": "cones", "from": [[0, 0, 0], [1, 0, 0]], "to": [[0, 1, 0], [1, 2, 0]],
       "radius_from": [0, 0.2], "radius_to": 0.3, "caps": false, "colors": ["#102030", [0, 1, 0.5]]}],
    "render": {"samples": 4, "max_depth": 5, "precision": "auto", "transfer": "linear"}
  })");
}

/// Stands for the absence of a key.
inline const json missing = json(json::value_t::discarded);

/// The document with the value at `pointer` replaced, or taken away.
inline json changed(const std::string& pointer, const json& value) {
  json result = full_document();
  const json::json_pointer place(pointer);
  if (value.is_discarded())
    result[place.parent_pointer()].erase(place.back());
  else
    result[place] = value;
  return result;
}

}  // namespace raytracer::test

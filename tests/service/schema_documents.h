// Documents that break one rule of scenes each, as changes of a valid one.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace raytracer::test {

/// Everything that a document may have, once.
inline const nlohmann::json full_scene = nlohmann::json::parse(R"({
  "$schema": "/schema/scene.json", "name": "n", "description": "d",
  "camera": {"origin": [0, 8, -20], "look_at": [0, -1, 0], "up": [0, 1, 0], "fov": 1.0,
             "width": 70, "height": 50},
  "background": "#87ccEB", "ambient": 0.2, "shadows": "ambient",
  "lights": [{"type": "distant", "direction": [-0.6, -1, 0.7], "color": [1, 1, 1],
              "intensity": 0.9, "angle": 0.01},
             {"type": "point", "position": [0, 10, 0], "color": "#ffeedd", "intensity": 1500,
              "falloff": "inverse_square", "radius": 0.5},
             {"type": "sky", "color": [0.5, 0.6, 0.7], "intensity": 0.3, "reach": 4}],
  "materials": {"red": {"color": [0.9, 0.2, 0.2], "ka": 1, "kd": 0.7, "ks": 0.3, "shininess": 50,
                        "reflectivity": 0, "transparency": 0, "ior": 1.5, "fresnel": false}},
  "objects": [{"type": "sphere", "center": [-2.5, 0, 0], "radius": 2, "material": "red"},
              {"type": "sphere_square", "center": [0, -3, 0], "radius": 0.5, "n": 14,
               "axes": "xz", "material": {"kd": 1}},
              {"type": "spheres", "centers": [[0, 0, 0], [1, 0, 0]], "radius": [0.1, 0.2]},
              {"type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0]},
              {"type": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
               "triangles": [[0, 1, 2]], "normals": [[0, 0, 1], [0.5, 0, 2], [0, 0, 3]],
               "colors": ["#102030", [0, 1, 0.5], [1, 1, 1]]},
              {"type": "cylinder", "from": [0, 0, 0], "to": [0, 3, 0], "radius": 0.5,
               "caps": true},
              {"type": "cylinders", "from": [[0, 0, 0], [1, 0, 0]], "to": [[0, 1, 0], [1, 2, 0]],
               "radius": [0.1, 0.2], "caps": false, "colors": ["#102030", [0, 1, 0.5]]},
              {"type": "cone", "from": [0, 0, 0], "to": [0, 3, 0], "radius_from": 0.5,
               "radius_to": 0, "caps": true},
              {"type": "cones", "from": [[0, 0, 0], [1, 0, 0]], "to": [[0, 1, 0], [1, 2, 0]],
               "radius_from": [0, 0.2], "radius_to": 0.3, "caps": false,
               "colors": ["#102030", [0, 1, 0.5]]}],
  "render": {"samples": 4, "max_depth": 5, "precision": "auto", "transfer": "linear"}
})");

/// What to put where; a null document value removes the key.
struct Change {
  std::string pointer;
  nlohmann::json value;
  bool removes = false;
};

inline Change set(std::string pointer, const char* json) {
  return {std::move(pointer), nlohmann::json::parse(json)};
}
inline Change without(std::string pointer) { return {std::move(pointer), nullptr, true}; }

inline nlohmann::json changed(const Change& change) {
  nlohmann::json document = full_scene;
  const nlohmann::json::json_pointer place(change.pointer);
  if (change.removes)
    document[place.parent_pointer()].erase(place.back());
  else
    document[place] = change.value;
  return document;
}

/// Still valid.
inline const std::vector<Change> right_changes{
    without("/camera/up"),
    without("/background"),
    without("/ambient"),
    without("/shadows"),
    without("/lights"),
    without("/objects"),
    without("/render"),
    without("/name"),
    set("/lights", "[]"),
    set("/background", "[0, 0.5, 1]"),
    set("/background", "\"transparent\""),
    set("/ambient", "3"),
    set("/shadows", "\"off\""),
    set("/camera/fov", "8.377580409572781"),
    set("/camera/fov", "-5"),
    set("/objects/0/radius", "1e-300"),
    set("/objects/1/n", "1000000000"),
    set("/objects/1/axes", "\"yz\""),
    set("/objects/2/radius", "0.5"),
    set("/objects/2/centers", "[[0, 0, 0], [0, 0, 0]]"),
    set("/objects/3/normal", "[0, -3e-5, 0]"),
    set("/objects/4/triangles", "[]"),
    without("/objects/4/normals"),
    without("/objects/4/colors"),
    set("/objects/2/colors", "[\"#102030\", [0, 0, 1]]"),
    without("/objects/5/caps"),
    set("/objects/5/caps", "false"),
    without("/objects/6/caps"),
    without("/objects/6/colors"),
    set("/objects/6/radius", "1e9"),
    set("/objects/7/radius_to", "0.25"),
    set("/objects/8/radius_from", "0"),
    set("/materials/red", "{}"),
    set("/materials/red/shininess", "0"),
    set("/materials/red/transparency", "1"),
    set("/materials/red/ior", "1"),
    set("/materials/red/fresnel", "true"),
    set("/render", "{}"),
    set("/render", "{\"target_rmse\": 0.5}"),
    set("/render", "{\"target_rmse\": 0.5, \"budget_ms\": 1e9}"),
    set("/render/max_depth", "0"),
    set("/lights/0/intensity", "0"),
    set("/lights/1/falloff", "\"none\""),
    set("/lights/0/angle", "3.1"),
    set("/lights/1/radius", "0"),
    set("/lights/2", "{\"type\": \"sky\"}"),
};

/// Wrong, and the schema can say so.
inline const std::vector<Change> wrong_changes{
    without("/camera"),
    without("/camera/origin"),
    without("/camera/look_at"),
    without("/camera/fov"),
    without("/camera/width"),
    without("/camera/height"),
    set("/camera", "[]"),
    set("/camera/origin", "[0, 0]"),
    set("/camera/origin", "[0, 0, 0, 0]"),
    set("/camera/origin", "[0, 0, \"0\"]"),
    set("/camera/up", "[0, 0, 0]"),
    set("/camera/fov", "\"wide\""),
    set("/camera/fov", "0"),
    set("/camera/width", "0"),
    set("/camera/width", "-70"),
    set("/camera/width", "70.5"),
    set("/camera/height", "null"),
    set("/camera/roll", "1"),
    set("/background", "[0, 0, 1.5]"),
    set("/background", "[0, 0, -0.1]"),
    set("/background", "[0, 0]"),
    set("/background", "\"#12345\""),
    set("/background", "\"#12345g\""),
    set("/background", "\"red\""),
    set("/background", "\"Transparent\""),
    set("/materials/red/color", "\"transparent\""),
    set("/background", "7"),
    set("/ambient", "-0.1"),
    set("/ambient", "true"),
    set("/shadows", "\"soft\""),
    set("/shadows", "null"),
    set("/name", "7"),
    set("/description", "[]"),
    set("/$schema", "1"),
    set("/colour", "1"),
    set("/lights", "{}"),
    set("/lights/0", "1"),
    without("/lights/0/type"),
    set("/lights/0/type", "\"spot\""),
    without("/lights/0/direction"),
    set("/lights/0/direction", "[0, 0, 0]"),
    set("/lights/0/position", "[0, 0, 0]"),
    set("/lights/0/intensity", "-1"),
    set("/lights/0/color", "[2, 0, 0]"),
    without("/lights/1/position"),
    set("/lights/1/falloff", "\"linear\""),
    set("/lights/0/falloff", "\"none\""),
    set("/lights/1/direction", "[0, 0, 1]"),
    set("/lights/0/angle", "3.15"),
    set("/lights/0/angle", "-0.1"),
    set("/lights/0/radius", "1"),
    set("/lights/1/angle", "0.1"),
    set("/lights/1/radius", "-1"),
    set("/lights/2/reach", "0"),
    set("/lights/2/direction", "[0, 0, 1]"),
    set("/materials", "[]"),
    set("/materials/red", "1"),
    set("/materials/red/ka", "1.1"),
    set("/materials/red/kd", "-0.1"),
    set("/materials/red/ks", "\"0\""),
    set("/materials/red/shininess", "-1"),
    set("/materials/red/reflectivity", "2"),
    set("/materials/red/transparency", "1.1"),
    set("/materials/red/ior", "0.9"),
    set("/materials/red/fresnel", "0.04"),
    set("/materials/red/colour", "[1, 1, 1]"),
    set("/materials/unused", "{\"ka\": 7}"),
    set("/objects", "{}"),
    set("/objects/0", "\"sphere\""),
    set("/objects/0", "{}"),
    set("/objects/0/type", "\"ball\""),
    without("/objects/0/center"),
    without("/objects/0/radius"),
    set("/objects/0/radius", "0"),
    set("/objects/0/radius", "-1"),
    set("/objects/0/radius", "[1]"),
    set("/objects/0/n", "3"),
    set("/objects/0/material", "7"),
    set("/objects/0/material", "{\"red\": 1}"),
    without("/objects/1/n"),
    set("/objects/1/n", "0"),
    set("/objects/1/n", "1000000001"),
    set("/objects/1/n", "1.5"),
    set("/objects/1/axes", "\"zx\""),
    set("/objects/1/radius", "0"),
    without("/objects/2/centers"),
    set("/objects/2/centers", "[[0, 0]]"),
    set("/objects/2/radius", "[0.1, 0]"),
    without("/objects/3/point"),
    without("/objects/3/normal"),
    set("/objects/3/normal", "[0, 0, 0]"),
    without("/objects/4/vertices"),
    without("/objects/4/triangles"),
    set("/objects/4/triangles", "[[0, 1]]"),
    set("/objects/4/triangles", "[[0, 1, 2, 0]]"),
    set("/objects/4/triangles", "[[0, 1, -1]]"),
    set("/objects/4/triangles", "[[0, 1, 0.5]]"),
    set("/objects/4/vertices", "[[0, 0, 0], 1]"),
    set("/objects/4/normals", "[[0, 0, 1], [0, 0, 0], [0, 0, 1]]"),
    set("/objects/4/normals", "[0, 0, 1]"),
    set("/objects/4/colors", "[\"#102030\", \"red\", \"#102030\"]"),
    set("/objects/2/colors", "\"#102030\""),
    set("/objects/2/colors", "[\"red\", \"#102030\"]"),
    without("/objects/5/from"),
    without("/objects/5/to"),
    without("/objects/5/radius"),
    set("/objects/5/from", "[[0, 0, 0]]"),
    set("/objects/5/to", "[0, 1]"),
    set("/objects/5/radius", "0"),
    set("/objects/5/radius", "[0.5]"),
    set("/objects/5/caps", "1"),
    set("/objects/5/caps", "null"),
    set("/objects/5/colors", "[\"#102030\"]"),
    without("/objects/6/from"),
    without("/objects/6/to"),
    without("/objects/6/radius"),
    set("/objects/6/from", "[0, 0, 0]"),
    set("/objects/6/to", "[[0, 1, 0], [1, 2]]"),
    set("/objects/6/radius", "[0.1, -0.2]"),
    set("/objects/6/radius", "-1"),
    set("/objects/6/caps", "[true, false]"),
    set("/objects/6/colors", "[[0, 1, 1.5], [0, 1, 0.5]]"),
    set("/objects/6/centers", "[[0, 0, 0], [1, 0, 0]]"),
    without("/objects/7/radius_from"),
    without("/objects/7/radius_to"),
    set("/objects/7/radius_from", "-1"),
    set("/objects/7/radius_to", "[0.5]"),
    set("/objects/7/radius", "1"),
    set("/objects/8/radius_from", "[0.1, -0.2]"),
    without("/objects/8/radius_to"),
    set("/render", "[]"),
    set("/render/samples", "0"),
    set("/render/samples", "1.5"),
    set("/render/target_rmse", "0.1"),
    set("/render/budget_ms", "10"),
    set("/render", "{\"target_rmse\": 0}"),
    set("/render", "{\"budget_ms\": -1}"),
    set("/render/precision", "\"half\""),
    set("/render/max_depth", "-1"),
    set("/render/max_depth", "1.5"),
    set("/render/transfer", "\"gamma\""),
    set("/render/sample", "1"),
};

/// Wrong for reasons that JSON Schema has no words for; the schema's description lists them.
inline const std::vector<Change> wrong_beyond_schema{
    set("/camera/look_at", "[0, 8, -20]"),  // differs from origin
    set("/camera/fov", "3.5"),              // modulo 2 pi within (0, pi)
    set("/camera/fov", "3.141592653589793"),
    set("/objects/0/material", "\"rde\""),  // a name that exists
    set("/objects/2/radius", "[0.1]"),      // as many as centers
    set("/objects/2/colors", "[[0, 0, 1]]"),
    set("/objects/5/to", "[0, 0, 0]"),               // differs from `from`
    set("/objects/6/to", "[[0, 1, 0], [1, 0, 0]]"),  // each from its own
    set("/objects/6/to", "[[0, 1, 0]]"),             // as many as `from`
    set("/objects/6/radius", "[0.1]"),
    set("/objects/6/colors", "[\"#102030\"]"),
    set("/objects/7/radius_from", "0"),  // not 0 at both ends
    set("/objects/8/radius_to", "[0, 1]"),
    set("/objects/4/normals", "[[0, 0, 1]]"),  // as many as vertices
    set("/objects/4/colors", "[\"#102030\"]"),
    set("/objects/4/triangles", "[[0, 1, 3]]"),  // indices below the vertices' number
};

}  // namespace raytracer::test

#include "tests/measure/scenes/ground_scenes.h"

#include <fmt/format.h>

#include "tests/measure/scenes/dice.h"
#include "tests/measure/scenes/document_text.h"

namespace raytracer::measure {
namespace {

/// `mirror` and `glass` name materials.
std::string document(const std::string& light, const char* mirror, const char* glass) {
  constexpr int half = 11;
  constexpr double radius = 0.2;
  Dice dice(31);
  SpheresText matt_balls;
  SpheresText mirror_balls;
  SpheresText glass_balls;
  for (int row = -half; row < half; ++row)
    for (int column = -half; column < half; ++column) {
      const double x = column + dice.within(0, 0.9);
      const double z = row + dice.within(0, 0.9);
      const double chance = dice.within(0, 1);
      SpheresText& balls = chance < 0.8 ? matt_balls : chance < 0.95 ? mirror_balls : glass_balls;
      balls.add({x, radius, z}, radius);
    }
  matt_balls.add({-4, 1, 0}, 1);
  glass_balls.add({0, 1, 0}, 1);
  mirror_balls.add({4, 1, 0}, 1);
  return fmt::format(R"({{
  "camera": {{"origin": [13, 2, 3], "look_at": [0, 0, 0], "fov": 0.4, "width": 700, "height": 500}},
  "background": [0.5, 0.7, 1],
  "ambient": 0.1,
  "lights": [{}],
  "materials": {{
    "ground": {{"color": [0.5, 0.5, 0.5], "kd": 0.8, "ks": 0}},
    "matt": {{"color": [0.7, 0.3, 0.2], "kd": 0.8, "ks": 0.1, "shininess": 20}},
    "mirror": {{"color": [0.7, 0.6, 0.5], "kd": 0.3, "ks": 0.2, "reflectivity": 0.6}},
    "glass": {{"kd": 0, "ks": 0.2, "shininess": 80, "transparency": 1, "ior": 1.5, "fresnel": true}}
  }},
  "objects": [
    {{"type": "sphere", "center": [0, -1000, 0], "radius": 1000, "material": "ground"}},
{},
{},
{}
  ]
}})",
                     light, matt_balls.object("matt"), mirror_balls.object(mirror),
                     glass_balls.object(glass));
}

}  // namespace

std::string balls_on_ground_sphere() {
  return document(R"({"type": "distant", "direction": [-1, -2, -0.7], "intensity": 0.9})", "mirror",
                  "glass");
}

std::string balls_on_ground_sphere_under_sky() {
  return document(R"({"type": "sky", "intensity": 0.8})", "matt", "matt");
}

}  // namespace raytracer::measure

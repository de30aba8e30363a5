// The scenes that every kernel, instruction set and finder must draw alike.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace raytracer::test {

inline constexpr const char* distant_lights =
    R"({"type": "distant", "direction": [-0.6, -1, 0.7]},
       {"type": "distant", "direction": [0.6, -0.4, 0.5], "intensity": 0.5})";
inline constexpr const char* point_light =
    R"({"type": "point", "position": [4, 6, -5], "intensity": 900})";

struct NamedScene {
  std::string name;
  Scene scene;
};

/// The document's scene, 160 pixels wide, of one sample a pixel and without a transfer curve.
Scene prepared(const std::string& text);

/// A scene of its own, so that what a test changes of it stays there.
Scene with_objects(const std::string& objects, const std::string& lights);

/// The shipped ones, and some for each kind of object under each kind of light.
std::vector<NamedScene> scenes();

}  // namespace raytracer::test

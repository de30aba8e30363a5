// A scene that takes minutes, for tests of what happens meanwhile.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>

namespace raytracer::test {

/// A sphere that fills the picture under a hundred lights: the shadow rays are the work. Each tile
/// takes a fraction of a second, so that what stops within one tile stops soon.
inline std::string endless_scene() {
  std::string text = R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.25,
    "width": 2000, "height": 2000},
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}],
    "render": {"samples": 100}, "lights": [)";
  for (int i = 0; i < 100; ++i)
    fmt::format_to(std::back_inserter(text), R"({}{{"type": "distant", "direction": [{}, 1, 9]}})",
                   i == 0 ? "" : ",", i - 50);
  return text + "]}";
}

}  // namespace raytracer::test

// The scene documents that the tests of the service post.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "tests/process/endless_scene.h"

namespace raytracer::test {

inline constexpr std::string_view json_type = "application/json";
inline constexpr std::string_view png_type = "image/png";
inline constexpr std::string_view ppm_type = "image/x-portable-pixmap";
inline constexpr std::string_view pfm_type = "image/x-portable-floatmap";

/// A lit red sphere before blue, 12 x 8 pixels.
inline const std::string small_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 12, "height": 8},
  "background": [0.1, 0.2, 0.8],
  "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
               "material": {"color": [0.9, 0.1, 0.1]}}]
})";

/// The same sphere before nothing.
inline const std::string transparent_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 12, "height": 8},
  "background": "transparent",
  "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
               "material": {"color": [0.9, 0.1, 0.1]}}]
})";

/// Another picture that takes as long, for each number: equal ones would be rendered once.
inline std::string as_another_picture(std::string document, int number) {
  return document.replace(0, 1, fmt::format(R"({{"ambient": {},)", number));
}

/// The same sphere in `side` x `side` pixels, each of `samples`: work as much as one likes.
inline std::string square_scene(int side, int samples) {
  return fmt::format(
      R"({{"camera": {{"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.5,
                       "width": {0}, "height": {0}}},
           "lights": [{{"type": "distant", "direction": [-1, -1, 2]}}],
           "objects": [{{"type": "sphere", "center": [0, 0, 0], "radius": 1}}],
           "render": {{"samples": {1}}}}})",
      side, samples);
}

}  // namespace raytracer::test

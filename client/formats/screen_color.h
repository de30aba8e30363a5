// Colours as screens show them and as light adds up: sRGB (IEC 61966-2-1) and its linear shares.
#pragma once

#include <cmath>
#include <cstdint>

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// Of 0xRRGGBB.
constexpr model::Rgb screen_color(std::uint32_t rgb) {
  const auto share = [](std::uint32_t byte) { return static_cast<float>(byte & 0xFF) / 255; };
  return {share(rgb >> 16), share(rgb >> 8), share(rgb)};
}

inline model::Rgb linear(const model::Rgb& on_screen) {
  model::Rgb light{};
  for (std::size_t i = 0; i < 3; ++i) {
    const float share = on_screen[i];
    light[i] = share <= 0.04045F ? share / 12.92F : std::pow((share + 0.055F) / 1.055F, 2.4F);
  }
  return light;
}

}  // namespace raytracer::client

// What a light does to a surface that it does not reach.
#pragma once

#include <cstdint>

namespace raytracer {

/// What such a surface shows of that light's ambient part: none or all of it; `off`: every light
/// reaches every surface that faces it.
enum class Shadows : std::uint8_t { black, ambient, off };

}  // namespace raytracer

// From linear light to what is stored, and back.
#pragma once

#include <cstdint>

namespace raytracer {

enum class Transfer : std::uint8_t { linear, srgb };

/// sRGB's curve (IEC 61966-2-1): up to `straight_end` of linear light `slope` times that, beyond it
/// scale * light^(1 / exponent) - offset.
struct SrgbCurve {
  static constexpr double straight_end = 0.0031308;
  static constexpr double slope = 12.92;
  static constexpr double scale = 1.055;
  static constexpr double offset = 0.055;
  static constexpr double exponent = 2.4;
};

/// A channel in [0, 1] as it is stored: unchanged, or sRGB-encoded.
double encode_channel(double linear, Transfer transfer);

/// The way back.
double decode_channel(double stored, Transfer transfer);

}  // namespace raytracer

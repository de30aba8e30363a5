// From linear light to what is stored, and back.
#pragma once

#include <cstdint>

namespace raytracer {

enum class Transfer : std::uint8_t { linear, srgb };

/// A channel in [0, 1] as it is stored: unchanged, or sRGB-encoded (IEC 61966-2-1).
double encode_channel(double linear, Transfer transfer);

/// The way back.
double decode_channel(double stored, Transfer transfer);

}  // namespace raytracer

// The lanes of a packet as bits, where something is kept for each of them.
#pragma once

#include <cstdint>
#include <limits>

namespace raytracer {

using LaneBits = std::uint16_t;
inline constexpr std::uint32_t most_lanes = std::numeric_limits<LaneBits>::digits;

}  // namespace raytracer

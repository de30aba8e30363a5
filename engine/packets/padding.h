// How far packets reach beyond what they are meant to read.
#pragma once

#include <cstddef>

namespace raytracer {

/// By so many values arrays are longer than what they hold if packets are loaded from them, because
/// one may begin with the last of these: more than any vector has.
inline constexpr std::size_t packet_padding = 64;

}  // namespace raytracer

// Which image format a client prefers: proactive negotiation by its Accept field (RFC
// 9110, 12.5.1).
#pragma once

#include <optional>
#include <string_view>

#include "engine/engine.h"

namespace raytracer {

std::string_view media_type(ImageFormat format);

/// The format with the highest weight, the most specific range deciding each format's weight and
/// png, ppm, pfm the order of equals; an empty field accepts everything. Nothing if no format is
/// acceptable. Ranges that cannot be read count for nothing.
std::optional<ImageFormat> choose_format(std::string_view accept);

}  // namespace raytracer

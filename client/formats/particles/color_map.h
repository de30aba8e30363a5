// Colour maps, in which equal steps of a number look equal: viridis and magma by S. van der Walt
// and N. Smith (matplotlib, CC0), coolwarm by K. Moreland, "Diverging Color Maps for Scientific
// Visualization", ISVC 2009.
#pragma once

#include <array>
#include <string_view>

#include "client/formats/scene_model.h"

namespace raytracer::client {

inline constexpr std::array<std::string_view, 3> color_maps{"viridis", "magma", "coolwarm"};

/// As screens show it. `map` is one of these, `share` from 0 to 1.
model::Rgb color_on_map(std::string_view map, float share);

}  // namespace raytracer::client

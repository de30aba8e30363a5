// The published trade of one scene as a drawing: error against time, both logarithmic.
//
// Self-contained; its colours follow the reader's choice of light or dark, and every series is told
// by its mark and a name beside it, too.
#pragma once

#include <cstddef>
#include <string>

#include "tests/measure/tradeoff/equal_error.h"

namespace raytracer::published {

/// A complete SVG document.
std::string trade_svg(const EqualErrorFigures& figures, std::size_t thread_count);

}  // namespace raytracer::published

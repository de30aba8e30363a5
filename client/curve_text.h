// A curve as people read it in a terminal: a table, and what to choose.
#pragma once

#include <string>

#include "client/curve.h"

namespace raytracer::client {

/// Lines of plain ASCII, at most 80 wide but for a long `label`.
std::string curve_text(const Curve& curve, const std::string& label);

}  // namespace raytracer::client

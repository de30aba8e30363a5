// A curve as a drawing: error against time, both logarithmic.
//
// Self-contained: no script, no font and no picture from elsewhere. Its colours follow the
// reader's choice of light or dark. Shape and colour both say what was set, so that either is
// enough; points of the Pareto front are filled, joined and named.
#pragma once

#include <string>

#include "client/curve.h"

namespace raytracer::client {

/// A complete SVG document. `label` names the scene.
std::string curve_svg(const Curve& curve, const std::string& label);

}  // namespace raytracer::client

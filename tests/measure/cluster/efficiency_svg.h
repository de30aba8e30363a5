// A drawing of efficiency against the number of workers.
#pragma once

#include <string>
#include <vector>

#include "tests/measure/cluster/simulation.h"

namespace raytracer::measure {

struct EfficiencyCurve {
  std::string name;
  std::vector<SimulatedJob> jobs;  ///< by the number of workers
};

/// A whole SVG document, for light and dark pages.
std::string efficiency_svg(const std::vector<EfficiencyCurve>& curves);

}  // namespace raytracer::measure

// The middle of what was measured.
#pragma once

#include <vector>

namespace raytracer::measure {

/// Of at least one value; of an even number the mean of the two in the middle.
double median(std::vector<double> values);

}  // namespace raytracer::measure

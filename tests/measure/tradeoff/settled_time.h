// How long something takes once caches, branches and threads are warm.
#pragma once

#include <functional>

namespace raytracer::published {

/// `measure_ms` runs it once and returns its time in milliseconds. The first time does not count,
/// unless it is a second or more; what takes less than 20 ms is run for 20 in all, and three times
/// at the least: the median.
double settled_ms(const std::function<double()>& measure_ms);

}  // namespace raytracer::published

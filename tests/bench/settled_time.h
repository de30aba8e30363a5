// How long something takes once caches, branches and threads are warm.
#pragma once

#include <functional>

namespace raytracer::bench {

/// `measure_ms` runs it once and returns its time in milliseconds. What takes less than 20 is run
/// again and again, for 20 in all and three times at the least: the median of these, without the
/// first.
double settled_ms(const std::function<double()>& measure_ms);

}  // namespace raytracer::bench

#include "engine/tradeoff/progress.h"

#include <cmath>

namespace raytracer {

void CurveProgress::begin_step(double from, double to) {
  const std::scoped_lock lock(mutex_);
  from_ = from;
  to_ = to;
  picture_.fraction = 0;
}

double CurveProgress::fraction() const {
  const std::scoped_lock lock(mutex_);
  return std::lerp(from_, to_, picture_.fraction.load());  // never beyond `to_`, by no rounding
}

}  // namespace raytracer

#include "engine/tradeoff/progress.h"

namespace raytracer {

void CurveProgress::begin_step(double from, double to) {
  const std::scoped_lock lock(mutex_);
  from_ = from;
  to_ = to;
  picture_.fraction = 0;
}

double CurveProgress::fraction() const {
  const std::scoped_lock lock(mutex_);
  return from_ + (to_ - from_) * picture_.fraction;
}

}  // namespace raytracer

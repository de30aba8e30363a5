// How far the measurement of a curve is: many pictures in a row, each a step of the whole.
#pragma once

#include <cmath>
#include <mutex>

#include "engine/render/progress.h"

namespace raytracer {

/// Between the thread that measures and those that watch it.
class CurveProgress {
 public:
  /// `picture` is that of the picture which is rendered now, begun anew with each; its `stop` ends
  /// the whole.
  explicit CurveProgress(RenderProgress& picture) : picture_(picture) {}

  RenderProgress& picture() { return picture_; }
  bool is_stopped() const { return picture_.stop; }

  /// The next picture takes the whole from one fraction to another.
  void begin_step(double from, double to) {
    const std::scoped_lock lock(mutex_);
    from_ = from;
    to_ = to;
    picture_.fraction = 0;
  }

  /// Of the whole, 0 to 1; never falls.
  double fraction() const {
    const std::scoped_lock lock(mutex_);
    return std::lerp(from_, to_, picture_.fraction.load());  // never beyond `to_`, by no rounding
  }

 private:
  RenderProgress& picture_;
  mutable std::mutex mutex_;  ///< a step and the picture's beginning change together
  double from_ = 0;
  double to_ = 0;
};

}  // namespace raytracer

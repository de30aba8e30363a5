// Corrections of estimated errors.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "engine/errors/error_model.h"
#include "engine/plan/scene_statistics.h"

namespace raytracer {

/// From the squared error that half buffers show to that of all samples, less as halves complete
/// each other.
struct ErrorMultiplier {
  double initial;  ///< before any refinement
  double least;    ///< that refinements are believed
};

/// If squared errors fall as n^-e, half buffers overstate them by 2^e - 1, as halves complete each
/// other: their errors' covariance is what all samples err less. Where objects are smaller than
/// pixels, e is that of random samples; otherwise it is taken between that and where edges cross.
ErrorMultiplier choose_error_multiplier(const SceneStatistics& statistics);

/// The sum of these squared errors: what is told of an image.
double sum_of(std::span<const double> errors2);

/// The same with its own uncertainty, to which contracts are held. It counts where few have an
/// error: that of k squares of normal numbers has a standard deviation of sqrt(2 / k) of itself.
double conservative_sum(std::span<const double> errors2);

/// The rms error of so many values, channels of pixels, whose squared errors sum up to `error2`.
inline double rms_of(double error2, std::size_t value_count) {
  return std::sqrt(error2 / static_cast<double>(value_count));
}

/// 1 / error_power() of pixels one after another, most of which have the samples of the one before.
/// Those without samples, beyond the rim, have no error.
class InversePower {
 public:
  float operator()(int samples) {
    if (samples != samples_) {
      samples_ = samples;
      inverse_ = samples > 0 ? static_cast<float>(1 / error_power(samples)) : 0;
    }
    return inverse_;
  }

 private:
  int samples_ = 0;
  float inverse_ = 0;
};

}  // namespace raytracer

// How the errors of samples fall, and how far an estimate of them is believed.
#pragma once

#include <span>

#include "engine/plan/census.h"

namespace raytracer {

/// n^3/2, by which squared errors fall with a number of samples n.
double error_power(int samples);

/// What the squared errors are of what PixelSpread and PartErrors tell.
struct ErrorScale {
  double first;  ///< before any refinement
  double least;  ///< that refinements are believed
};

/// Where spheres are small, samples do hardly better than random ones, whose scale is 1; otherwise
/// they do as between those and where edges cross pixels.
ErrorScale error_scale(const Census& census);

/// The sum of these squared errors with its own uncertainty, which counts where few have an error:
/// that of k squares of normal numbers has a standard deviation of sqrt(2 / k) of itself, of which
/// two are added.
double conservative_sum(std::span<const double> errors2);

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

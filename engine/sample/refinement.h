// Which parts of an image get more samples, and how many.
//
// A part's squared error is taken to fall as n^-3/2 with its n samples, as where edges cross
// pixels; where there is more detail than samples it falls more slowly, and takes more passes. The
// sum of squared errors is brought to a bound by the fewest samples if all parts' errors per sample
// are equal (Lagrange), which is where n grows as detail^2/5, detail being the squared error of one
// sample: a common level of the errors per sample tells every part its number.
//
// New samples replace the old ones, as even spread is worth more than their sum: a part that is
// refined gets at least twice as many, and at most sixteen times, because the error that asks for
// them is an estimate.
#pragma once

#include <span>
#include <vector>

#include "engine/plan/census.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// 4 x 4 pixels, those of them that the image has.
struct ImagePart {
  int samples = 1;    ///< per pixel; 0 where a part beside it stands for it
  double error2 = 0;  ///< estimated: the sum of its values' squared errors
};

/// The most samples per pixel that the limits grant a contract on this scene, with those before
/// them, which are at most as many; at least 1.
int most_samples(const Scene& scene, const Limits& limits);

/// The samples per pixel that all parts get before any is chosen, of at most so many: as many as
/// probing_samples() says, or fewer in two halves, or a single one.
int first_compared_samples(const Census& census, int most_samples);

/// How squared errors fall with the samples: as their power -e.
class ErrorFall {
 public:
  /// A guess, before any are compared.
  explicit ErrorFall(const Census& census);

  /// Takes in what a refinement has shown. Parts whose samples did not grow are not looked at.
  void include(std::span<const ImagePart> before, std::span<const ImagePart> after);

  /// From 1, as of random samples, to 3/2, as where edges cross pixels.
  double exponent() const;

  /// By what factor the difference of two halves of samples overstates the squared error of all
  /// (PartErrors): if half of the samples have 2^e times the squared error u, half of the
  /// difference has the rest, (2^e - 1) u.
  double halves_excess() const;

 private:
  double guess_;
  double log_fall_ = 0;   ///< beyond the slowest, of all refinements
  double log_range_ = 0;  ///< between the slowest and the fastest
};

/// The parts of an image so many pixels wide and high with the errors that they probably have, from
/// those that their halves show; the parts are numbered as those of PartErrors. Where samples met
/// detail there is more beside it that they have missed: a part counts at least as a share of its
/// neighbours' mean does, at its own number of samples.
std::vector<ImagePart> expected_errors(std::span<const ImagePart> parts, int width, int height,
                                       double halves_excess);

/// The sum of these squared errors with its own uncertainty, which counts where few parts have an
/// error: that of k squares of normal numbers has a standard deviation of sqrt(2 / k) of itself, of
/// which two are added.
double conservative_sum(std::span<const ImagePart> parts);

/// What a refinement is for, and what it may cost.
struct RefinementGoal {
  double error2;     ///< to which the parts' sum is to fall; 0 for the least that can be reached
  double samples;    ///< at most so many per pixel times parts; infinite without a limit
  int most_samples;  ///< per pixel of any part, at least 4
};

/// For each part, of 4 samples or more, those per pixel that it gets next, or 0 if it stays as it
/// is. All stay if the goal is reached, or nothing can be done for it.
std::vector<int> next_samples(std::span<const ImagePart> parts, const RefinementGoal& goal);

}  // namespace raytracer

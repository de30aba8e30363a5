#include "engine/sample/error_calibration.h"

#include <algorithm>

#include "engine/errors/error_model.h"

namespace raytracer {

using Model = SampleErrorModel;

ErrorCalibration::ErrorCalibration(const ErrorMultiplier& multiplier)
    : refined_(multiplier.initial), left_(multiplier.initial), least_(multiplier.least) {}

void ErrorCalibration::tell(const ToldError& told, bool is_first) {
  now_ += told;
  if (is_first) ever_ += told;
}

double ErrorCalibration::lasting_share() const {
  return now_.after < now_.before ? now_.after / now_.before : 1;
}

void ErrorCalibration::learn(std::span<const double> expected, double change2, double left_error2) {
  now_ = {};
  double sum = 0;
  double squares = 0;
  for (const double error2 : expected) {
    sum += error2;
    squares += error2 * error2;
  }
  if (!(squares > 0)) return;
  const double weight = sum * sum / squares;  // as many pixels of equal errors would say as much
  const double growth =
      (change2 * weight / sum + Model::prior_pixels) / (weight + Model::prior_pixels);
  refined_ = std::clamp(refined_ * growth, least_, Model::most_multiplier);
  const double missed = std::max(ever_.before - ever_.after, 0.0);
  left_ = left_error2 > 0 ? std::min(refined_ * (1 + missed / left_error2), Model::most_multiplier)
                          : refined_;
}

}  // namespace raytracer

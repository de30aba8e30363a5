#include "engine/sample/error_calibration.h"

#include <algorithm>
#include <cstddef>

#include "engine/errors/error_model.h"

namespace raytracer {

using Model = SampleErrorModel;

ErrorCalibration::ErrorCalibration(const ErrorMultiplier& multiplier)
    : refined_(multiplier.initial), left_(multiplier.initial), least_(multiplier.least) {}

void ErrorCalibration::tell(const ToldError& told, bool is_first) {
  now_ += told;
  if (is_first) ever_ += told;
}

void ErrorCalibration::forget() {
  now_ = ever_ = {};
  left_ = refined_;
}

void ErrorCalibration::learn(std::span<const double> before, std::span<const double> after,
                             double change2, double left_error2) {
  const double lasting = now_.after < now_.before ? now_.after / now_.before : 1;
  now_ = {};
  double expected = 0;
  double squares = 0;  // with the luck: where that was much, little is known
  for (std::size_t i = 0; i < before.size(); ++i) {
    expected += lasting * before[i] + after[i];
    squares += (before[i] + after[i]) * (before[i] + after[i]);
  }
  if (squares > 0) {
    // As many pixels of equal errors would say as much.
    const double weight = expected * expected / squares;
    const double growth =
        (change2 * expected / squares + Model::prior_pixels) / (weight + Model::prior_pixels);
    refined_ = std::clamp(refined_ * growth, least_, Model::most_multiplier);
  }
  const double missed = std::max(ever_.before - ever_.after, 0.0);
  left_ = left_error2 > 0 ? std::min(refined_ * (1 + missed / left_error2), Model::most_multiplier)
                          : refined_;
}

}  // namespace raytracer

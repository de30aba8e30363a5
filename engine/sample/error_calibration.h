// How far half buffers overstate errors: nobody knows beforehand, refinements tell.
//
// What a refinement changes is what its pixels erred before it and after it. But they were chosen
// for what their samples told, of which a part was luck: what new samples tell of the same is less.
// As much as these had too much, those that were left have too little, as all together were told
// rightly on average.
#pragma once

#include <span>

#include "engine/sample/error_rules.h"

namespace raytracer {

/// What the variance of a pixel's samples told of its squared error in linear light, without a
/// multiplier, and what that of more samples tells of the same.
struct ToldError {
  double before = 0;
  double after = 0;

  ToldError& operator+=(const ToldError& other) {
    before += other.before;
    after += other.after;
    return *this;
  }
};

class ErrorCalibration {
 public:
  explicit ErrorCalibration(const ErrorMultiplier& multiplier);

  /// Of pixels that were refined, or have never been.
  double multiplier(bool is_refined) const { return is_refined ? refined_ : left_; }

  /// One more pixel is being refined, for the first time or again.
  void tell(const ToldError& told, bool is_first);
  /// Ends a refinement. By the multiplier of refined ones its pixels had these squared errors
  /// `before` it and have these `after` it, one each; then the sum of the squared differences that
  /// it made, and what all pixels that were never refined err in linear light, without a
  /// multiplier.
  void learn(std::span<const double> before, std::span<const double> after, double change2,
             double left_error2);

  /// None was ever refined; what has been learned of halves stays.
  void forget();

 private:
  double refined_;
  double left_;
  double least_;
  ToldError now_{};   ///< of the pixels being refined
  ToldError ever_{};  ///< of all pixels, when they were first refined
};

}  // namespace raytracer

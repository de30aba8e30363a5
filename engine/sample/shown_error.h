// From errors of linear light to those of the picture that is shown.
//
// sRGB is steep where it is dark: a deviation of 0.05 beside black shows as 0.25, in the middle as
// 0.05. So errors are estimated in linear light, where the mean of few samples says as much
// everywhere, and taken through the transfer at each pixel's own value. A pixel all of whose
// samples are black beside one that is lit then errs by as much as it does.
#pragma once

#include "engine/image/image.h"
#include "engine/scene/scene.h"

namespace raytracer {

class ShownError {
 public:
  /// Of an image as it is stored, which must outlive this.
  ShownError(const Image& image, Transfer transfer) : image_(image), transfer_(transfer) {}

  /// What a squared error of linear light, the sum over a pixel's channels, comes to, the same sum:
  /// the mean square of what normal deviations change.
  double operator()(double linear_error2, int x, int y) const {
    if (transfer_ == Transfer::linear || !(linear_error2 > 0)) return linear_error2;
    return of_pixel(linear_error2, image_.pixel(x, y), image_.channels);
  }

 private:
  static double of_pixel(double linear_error2, const float* pixel, int channels);

  const Image& image_;
  Transfer transfer_;
};

}  // namespace raytracer

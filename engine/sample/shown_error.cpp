#include "engine/sample/shown_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/math/transfer.h"

namespace raytracer {
namespace {

/// A rising function of [0, 1] as a polyline.
class Polyline {
 public:
  template <typename Function>
  explicit Polyline(const Function& function) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = function(static_cast<double>(i) / last);
  }

  double operator()(double x) const {
    const double place = std::clamp(x, 0.0, 1.0) * last;
    const auto i = std::min(static_cast<std::size_t>(place), last - 1);
    return values_[i] + (place - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr std::size_t last = 1024;
  std::array<double, last + 1> values_;
};

/// sRGB of the square of its argument, which is as straight near black as elsewhere, and back; and
/// by how much sRGB grows with light where it shows this, squared.
struct Curves {
  Polyline encoded_square{[](double root) { return encode_channel(root * root, Transfer::srgb); }};
  Polyline root_of{[](double shown) { return std::sqrt(decode_channel(shown, Transfer::srgb)); }};
  Polyline slope2{[](double shown) {
    constexpr double step = 1e-7;
    const double linear = decode_channel(shown, Transfer::srgb);
    const auto shown_at = [](double light) { return encode_channel(light, Transfer::srgb); };
    const double slope = (shown_at(linear + step) - shown_at(linear)) / step;
    return slope * slope;
  }};
};

}  // namespace

double ShownError::of_pixel(double linear_error2, const float* pixel, int channels) {
  static const Curves curves;
  // The mean of a square over normal deviations: a sixth of it lies at the root of three of their
  // standard deviation to either side, the rest at none (Gauss-Hermite quadrature of three points).
  constexpr double outer_place2 = 3;
  constexpr double outer_weight = 1.0 / 6;
  // A cover is shown as it is, and colours are multiplied by it after the transfer.
  const bool is_covered = channels == 4 && pixel[3] > 0;
  const double cover = is_covered ? static_cast<double>(pixel[3]) : 1;
  const double deviation2 = outer_place2 * linear_error2 / channels / (cover * cover);
  double sum = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const double shown = static_cast<double>(pixel[channel]) / cover;
    const double root = curves.root_of(shown);
    const double linear = root * root;
    // Within this share of the light, where sRGB shows a power of it, Taylor's series does as well:
    // its third term is less than 0.1 % of the square, and nothing is cut off.
    constexpr double near_share = 1.0 / 4;
    constexpr double least_of_power = SrgbCurve::straight_end / (1 - near_share);
    constexpr double power = 1 / SrgbCurve::exponent;
    constexpr double bend = (power - 1) * (power - 1) / 4 + (power - 1) * (power - 2) / 3;
    const double near = std::min(near_share * linear, 1 - linear);
    if (deviation2 <= near * near && linear >= least_of_power) {
      sum += 2 * outer_weight * cover * cover * curves.slope2(shown) * deviation2 *
             (1 + bend * deviation2 / (linear * linear));
      continue;
    }
    const double deviation = std::sqrt(deviation2);
    for (const double moved : {linear + deviation, linear - deviation}) {
      const double change =
          cover * (curves.encoded_square(std::sqrt(std::clamp(moved, 0.0, 1.0))) - shown);
      sum += outer_weight * change * change;
    }
  }
  return sum + (channels - 3) * linear_error2 / channels;
}

}  // namespace raytracer

#include "engine/math/transfer.h"

#include <cmath>

namespace raytracer {

double encode_channel(double linear, Transfer transfer) {
  if (transfer == Transfer::linear) return linear;
  using Curve = SrgbCurve;
  return linear <= Curve::straight_end
             ? Curve::slope * linear
             : Curve::scale * std::pow(linear, 1 / Curve::exponent) - Curve::offset;
}

double decode_channel(double stored, Transfer transfer) {
  if (transfer == Transfer::linear) return stored;
  using Curve = SrgbCurve;
  return stored <= Curve::slope * Curve::straight_end
             ? stored / Curve::slope
             : std::pow((stored + Curve::offset) / Curve::scale, Curve::exponent);
}

}  // namespace raytracer

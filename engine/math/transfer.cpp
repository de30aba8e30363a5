#include "engine/math/transfer.h"

#include <cmath>

namespace raytracer {

double encode_channel(double linear, Transfer transfer) {
  if (transfer == Transfer::linear) return linear;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decode_channel(double stored, Transfer transfer) {
  if (transfer == Transfer::linear) return stored;
  return stored <= 12.92 * 0.0031308 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}

}  // namespace raytracer

#include "engine/scene/camera_rules.h"

#include <cmath>
#include <limits>

namespace raytracer {

bool is_field_of_view(double angle) {
  if (angle > 0 && angle < 1) return true;  // however small
  const double sine = std::sin(angle / 2);
  const double cosine = std::cos(angle / 2);
  const double spacing =
      std::nextafter(std::abs(angle), std::numeric_limits<double>::infinity()) - std::abs(angle);
  return sine * cosine > 0 && 2 * std::abs(sine) > spacing && 2 * std::abs(cosine) > spacing;
}

}  // namespace raytracer

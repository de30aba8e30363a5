// Axis-aligned boxes that never lose what they bound to rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/ray.h"
#include "engine/math/vec.h"

namespace raytracer {

struct Box {
  Vec3 low{infinity, infinity, infinity};
  Vec3 high = -low;

  void include(const Box& box) {
    low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y), std::min(low.z, box.low.z)};
    high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y),
            std::max(high.z, box.high.z)};
  }
  void include(const Vec3& point) { include(Box{point, point}); }

  /// Grown on all sides by more than the rounding of coordinates of that magnitude.
  Box padded(double magnitude) const {
    constexpr double share = 0x1p-49;
    const double margin = share * std::max({magnitude, max_abs(low), max_abs(high)});
    return {low - Vec3{margin, margin, margin}, high + Vec3{margin, margin, margin}};
  }
};

/// A ray prepared for many boxes.
struct BoxRay {
  Vec3 origin;
  Vec3 inverse;  ///< 1 / direction: infinite where the direction is 0

  explicit BoxRay(const Ray& ray)
      : origin(ray.origin.point()),
        inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z} {}

  /// The distance at which the ray enters the box; infinity if it misses it before t_max.
  /// A coordinate in which the ray runs along a side gives 0 * infinity, not a number, which
  /// loses every comparison below: that side then does not limit the ray (Ize 2013).
  double enter(const Box& box, double t_max) const {
    double begin = 0;
    double end = t_max;
    clip(box.low.x, box.high.x, origin.x, inverse.x, begin, end);
    clip(box.low.y, box.high.y, origin.y, inverse.y, begin, end);
    clip(box.low.z, box.high.z, origin.z, inverse.z, begin, end);
    return begin <= end ? begin : infinity;
  }

 private:
  static void clip(double low, double high, double origin, double inverse, double& begin,
                   double& end) {
    constexpr double round_up = 1 + 4 * std::numeric_limits<double>::epsilon();
    const bool backwards = std::signbit(inverse);
    begin = std::max(begin, ((backwards ? high : low) - origin) * inverse);
    end = std::min(end, ((backwards ? low : high) - origin) * inverse * round_up);
  }
};

}  // namespace raytracer

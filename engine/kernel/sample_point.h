// A place in a pixel.
#pragma once

namespace raytracer {

/// 0 to 1 to the right and upwards.
struct SamplePoint {
  double x;
  double y;
};

}  // namespace raytracer

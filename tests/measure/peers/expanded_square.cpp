#include "tests/measure/peers/expanded_square.h"

namespace raytracer::peers {

Spheres expanded(const SphereSquare& square) {
  Vec3 first{1, 0, 0};
  Vec3 second{0, 0, 1};
  if (square.axes == Axes::xy) second = {0, 1, 0};
  if (square.axes == Axes::yz) first = {0, 1, 0};
  const std::int64_t side = 2 * square.n;
  const auto offset = [&](std::int64_t index) {
    return static_cast<double>(2 * index + 1 - side) * square.radius;
  };
  Spheres spheres;
  spheres.radii = {square.radius};
  spheres.centers.reserve(static_cast<std::size_t>(side * side));
  for (std::int64_t i = 0; i < side; ++i)
    for (std::int64_t k = 0; k < side; ++k)
      spheres.centers.push_back(square.center + first * offset(i) + second * offset(k));
  return spheres;
}

}  // namespace raytracer::peers

#include "engine/kernel/simd/long_walk.h"

#include <cstdint>

#include "engine/kernel/square.h"

namespace raytracer {

std::optional<LongWalkHit> finish_walk(const LongWalk& walk) {
  const double middle = (walk.side - 1) / 2;
  const auto side = static_cast<std::int64_t>(walk.side);
  const PackedSquare square{.center = {walk.low_first + middle, 0, walk.low_second + middle},
                            .radius = 0.5,
                            .side = side,
                            .object = 0,
                            .first_axis = 0,
                            .second_axis = 2,
                            .across = 1};
  Ray ray{Departure{}, walk.direction};
  ray.from.anchor = walk.origin;
  if (walk.leaves_own) {
    const auto first = static_cast<std::int64_t>(walk.own_first - walk.low_first);
    const auto second = static_cast<std::int64_t>(walk.own_second - walk.low_second);
    ray.from.surface = Departure::Surface::sphere_outside;
    ray.from.id = {0, static_cast<std::uint64_t>(first * side + second)};
  }
  const auto hit = intersect_square(ray, square);
  if (!hit) return {};
  const auto part = static_cast<std::int64_t>(hit->part);
  const std::int64_t first = part / side;
  const std::int64_t second = part % side;
  return LongWalkHit{hit->sphere.t, walk.low_first + static_cast<double>(first),
                     walk.low_second + static_cast<double>(second)};
}

}  // namespace raytracer

#include "engine/objects/lattice/long_walk.h"

#include <cstdint>

#include "engine/objects/lattice/lattice.h"

namespace raytracer {

std::optional<LongWalkHit> finish_walk(const LongWalk& walk) {
  const double middle = (walk.side - 1) / 2;
  const auto side = static_cast<std::int64_t>(walk.side);
  const PackedLattice lattice{.center = {walk.low_first + middle, 0, walk.low_second + middle},
                              .radius = 0.5,
                              .side = side,
                              .first_axis = 0,
                              .second_axis = 2,
                              .across = 1,
                              .id = {}};
  Ray ray{SurfacePoint{}, walk.direction};
  ray.origin.anchor = walk.origin;
  if (walk.leaves_own) {
    const auto first = static_cast<std::int64_t>(walk.own_first - walk.low_first);
    const auto second = static_cast<std::int64_t>(walk.own_second - walk.low_second);
    ray.origin.side = SurfacePoint::Side::round_outside;
    ray.origin.id = {0, static_cast<std::uint64_t>(first * side + second)};
  }
  const auto hit = intersect(ray, lattice);
  if (!hit) return {};
  const auto item = static_cast<std::int64_t>(hit->point.id.item);
  return LongWalkHit{hit->t, walk.low_first + static_cast<double>(item / side),
                     walk.low_second + static_cast<double>(item % side)};
}

}  // namespace raytracer

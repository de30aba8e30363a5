// How lattices lie in memory, and what the eye and the lights know of them beforehand.
#include "engine/objects/lattice/packets.h"

#include <algorithm>
#include <cmath>

namespace raytracer {
namespace {

/// The cells whose spheres come within a diameter of the line from a sphere's centre towards the
/// light: only they can stand between a point of that sphere and the light.
template <typename T>
Neighbours<T> neighbours_towards(const Vec3& towards, const PackedLattice& lattice) {
  constexpr int most_cells = 17;  // 1 / lowest_neighbour_slope
  const double first = component(towards, lattice.first_axis);
  const double second = component(towards, lattice.second_axis);
  if (elevation_sine(lattice, towards) < lowest_neighbour_slope) return {{}, 0, false};
  Neighbours<T> neighbours{{}, 0, true};
  for (int i = -most_cells; i <= most_cells; ++i) {
    for (int k = -most_cells; k <= most_cells; ++k) {
      if (i == 0 && k == 0) continue;
      const double forward = i * first + k * second;
      const double distance2 = i * i + k * k - forward * forward;
      if (!(forward > 0 && distance2 < 1)) continue;
      neighbours.cells.push_back({static_cast<T>(i), static_cast<T>(k),
                                  static_cast<T>(i * i + k * k), static_cast<T>(forward)});
      neighbours.reach =
          std::max(neighbours.reach, static_cast<T>(std::max(std::abs(i), std::abs(k))));
    }
  }
  return neighbours;
}

}  // namespace

template <typename T>
LatticeItem<T> PacketLayout<LatticeKind, T>::item(const PackedLattice& l, std::int32_t number) {
  const double cell = 2 * l.radius;
  // In cells from the centre, from which a whole number of them leads to the corner; cell i from
  // there is centred on i + 1/2.
  const double half = static_cast<double>(l.side) / 2;  // a whole number
  const double first = -component(l.center, l.first_axis) / cell;
  const double second = -component(l.center, l.second_axis) / cell;
  const double first_cell = std::floor(first);
  const double second_cell = std::floor(second);
  const double last = half - 1;
  return {{l.first_axis, l.across, l.second_axis},
          {static_cast<T>(first - first_cell - 0.5),
           static_cast<T>(-component(l.center, l.across) / cell),
           static_cast<T>(second - second_cell - 0.5)},
          static_cast<T>(-half - first_cell),
          static_cast<T>(last - first_cell),
          static_cast<T>(-half - second_cell),
          static_cast<T>(last - second_cell),
          static_cast<T>(1 / cell),
          static_cast<T>(cell),
          static_cast<T>(number)};
}

template <typename T>
std::vector<Neighbours<T>> PacketLayout<LatticeKind, T>::light_view(
    std::span<const PackedLattice> lattices, const PackedLight& light, const FinderRow&,
    const Numbering&, WorkerPool&) {
  std::vector<Neighbours<T>> view;
  view.reserve(lattices.size());
  for (const PackedLattice& lattice : lattices)
    view.push_back(light.rays == LightRays::parallel ? neighbours_towards<T>(light.place, lattice)
                                                     : Neighbours<T>{{}, 0, false});
  return view;
}

template struct PacketLayout<LatticeKind, float>;
template struct PacketLayout<LatticeKind, double>;

}  // namespace raytracer

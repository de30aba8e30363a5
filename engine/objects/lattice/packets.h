// Lattices as packets of rays read them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/lights/light_kind.h"
#include "engine/objects/lattice/lattice.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"

namespace raytracer {

/// In units of its cells (one cell is a sphere's diameter), its spanning axes first and last, the
/// axis across it in the middle. Cells have integer coordinates relative to the cell in which the
/// eye would stand.
template <typename T>
struct LatticeItem {
  std::array<int, 3> axes;  ///< of x, y, z: first, across, second
  Triple<T> eye;            ///< relative to the centre of the eye's cell
  T low_first;              ///< the cells' coordinates
  T high_first;
  T low_second;
  T high_second;
  T cells_per_unit;  ///< 1 / (2 radius)
  T unit_per_cell;
  T id;
};

/// A neighbour, by its offset in cells.
template <typename T>
struct NeighbourCell {
  T first;
  T second;
  T distance2;  ///< of the offset
  T forward;    ///< its part along the light's direction
};

/// For one distant light and one lattice: the neighbours that can shadow a sphere.
template <typename T>
struct Neighbours {
  std::vector<NeighbourCell<T>> cells;
  T reach;        ///< the largest coordinate of an offset
  bool suffices;  ///< false where the light is so low that only a walk will do
};

template <typename T>
struct PacketLayout<LatticeKind, T> : DefaultLayout {
  using Item = LatticeItem<T>;
  using LightView = std::vector<Neighbours<T>>;  ///< of each lattice

  static PrimitiveRow<T> row(const PackedLattice& l, std::size_t /*item*/) {
    return {.place = narrowed<T>(l.center), .curvature = PrimitiveRow<T>::own_normal};
  }
  static Item item(const PackedLattice& lattice, std::int32_t number);
  static LightView light_view(std::span<const PackedLattice> lattices, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers, WorkerPool& pool);
};

extern template struct PacketLayout<LatticeKind, float>;
extern template struct PacketLayout<LatticeKind, double>;

}  // namespace raytracer

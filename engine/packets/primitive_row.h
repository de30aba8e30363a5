// What rays from the eye and all hits need of each primitive, in rows by its number: neighbouring
// rays meet primitives that lie far from each other in memory, and a row is in one cache line.
#pragma once

#include "engine/math/triple.h"
#include "engine/memory/page_allocator.h"

namespace raytracer {

/// Of any kind. All members are T, so that a packet can gather one of many rows (rows-inl.h).
template <typename T>
struct PrimitiveRow {
  Triple<T> place;    ///< of round ones the centre; of flat ones the opposite of the normal
  T curvature{};      ///< 1 / radius; 0 if flat; `own_normal` where the kind computes it
  T radius_square{};  ///< of a sphere
  /// Of a sphere |center|^2 - radius^2, of what is flat normal . (point - eye).
  T eye_power{};
  /// Where the kind computes the normal, the place among its items. Of what is flat, where corners
  /// tell normals or colours, 1 more than the place among their rows; else 0.
  T item{};
  T material{};  ///< the place among the scene's materials

  static constexpr T own_normal = -1;
};

template <typename T>
using PrimitiveRows = LargeArray<PrimitiveRow<T>>;

}  // namespace raytracer

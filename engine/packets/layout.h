// What packets of rays load: values in the kernels' precision T, as structures and as columns.
//
// Each kind of object says in its packets.h how its primitives are laid out in memory, by
// specializing PacketLayout, with NoLayout for what it has not:
//
//   Item                     one primitive, for rays that try them one by one and for lists
//   Block                    eight in columns, a leaf of a tree
//   EyeView, LightView       what the eye or a light knows beforehand of all of them
//   bins_name_rows           whether screen bins name rows of the PrimitiveTable; else items
//   needs_items(finders)     whether any rays look at items
//   row(p, item's index), item(p, number), fill(p, number, place, block)
//   eye_view(primitives, finders, pool), light_view(primitives, light, finders, numbers, pool)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/finders/tree.h"
#include "engine/math/triple.h"

namespace raytracer {

/// At most the largest T.
template <typename T>
T finite(double value) {
  return static_cast<T>(std::min<double>(value, std::numeric_limits<T>::max()));
}

/// One value of the primitives of a tree's leaf.
template <typename T>
using BlockColumn = std::array<T, Tree::leaf_size>;

/// What hits need of a primitive, whatever its kind.
template <typename T>
struct PrimitiveRow {
  Triple<T> place;  ///< of round ones the centre; of flat ones the opposite of the normal
  T curvature;      ///< 1 / radius; 0 if flat; `own_normal` where the kind computes it
  T radius2;        ///< of a sphere; where the kind computes the normal, the item's index
  T eye_c;          ///< of a sphere |center|^2 - radius^2

  static constexpr T own_normal = -1;
};

/// Of kinds that lack one of the layouts.
struct NoLayout {
  std::uint32_t count = 0;
  static NoLayout empty() { return {}; }
};

/// Specialized by each kind of object.
template <class Kind, typename T>
struct PacketLayout;

}  // namespace raytracer

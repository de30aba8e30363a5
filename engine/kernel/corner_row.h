// Normals and colours that the corners around a hit tell, as packets read them.
#pragma once

#include <array>
#include <cstddef>

#include "engine/math/triple.h"
#include "engine/objects/corner_values.h"

namespace raytracer {

/// Of one primitive with three corners a, b and c. All members are T, so that a packet can gather
/// one of many rows. At p the corners' weights are those of b and c, which are affine, and the
/// rest.
template <typename T>
struct CornerRow {
  Triple<T> b_slope;  ///< the weight of b is b_slope . p + b_offset
  Triple<T> c_slope;
  T b_offset;
  T c_offset;
  T has_normals;  ///< 0 or 1
  T has_colors;
  Triple<T> normal;    ///< of a
  Triple<T> b_normal;  ///< of b, from that of a
  Triple<T> c_normal;
  Triple<T> color;  ///< likewise
  Triple<T> b_color;
  Triple<T> c_color;
  std::array<T, 4> unused;  ///< to a power of two
};

template <typename T>
CornerRow<T> corner_row(const std::array<Vec3, 3>& corners, const CornerValues& values,
                        std::size_t item);

extern template CornerRow<float> corner_row<float>(const std::array<Vec3, 3>&, const CornerValues&,
                                                   std::size_t);
extern template CornerRow<double> corner_row<double>(const std::array<Vec3, 3>&,
                                                     const CornerValues&, std::size_t);

}  // namespace raytracer

// The spheres that one part of a block may show, explicit ones and those of squares.

#if defined(RAYTRACER_KERNEL_SIMD_PART_SPHERES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_PART_SPHERES_INL_H_
#undef RAYTRACER_KERNEL_SIMD_PART_SPHERES_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_PART_SPHERES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/kernel/simd/contents-inl.h"
#include "engine/kernel/simd/eye-inl.h"
#include "engine/kernel/simd/pixel_contents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Spheres near to far: in the order of their powers with respect to the eye, |c|^2 - r^2, in which
/// none of those that do not intersect stands before an earlier one (H. Edelsbrunner, An acyclicity
/// theorem for cell complexes in d dimensions, 1990, of power diagrams, each of whose cells holds
/// its ball).
template <typename T>
struct PartSpheres {
  static constexpr std::size_t most = 24;
  static constexpr std::size_t row_size = 32;
  static_assert(row_size * sizeof(T) % 64 == 0, "rows are loaded by whole packets");
  enum Value : std::size_t {
    x,
    y,
    z,
    radius2,
    curvature,  ///< 1 / radius
    eye_c,      ///< the power
    id,
    material,
    first,  ///< a square's cell; no_cell for others
    second,
    value_count
  };
  static constexpr T no_cell = std::numeric_limits<T>::max();

  alignas(64) T values[value_count][row_size];
  std::size_t count = 0;
  bool are_all = true;  ///< that the part may show, and none intersects another

  void clear() {
    count = 0;
    are_all = true;
  }

  void add(const std::array<T, value_count>& sphere) {
    if (count == most || touches_one(sphere)) {
      are_all = false;
      return;
    }
    std::size_t place = count++;
    for (; place > 0 && values[eye_c][place - 1] > sphere[eye_c]; --place)
      for (auto& column : values) column[place] = column[place - 1];
    for (std::size_t i = 0; i < value_count; ++i) values[i][place] = sphere[i];
  }

 private:
  /// Spheres of a square touch each other, and do not intersect.
  bool touches_one(const std::array<T, value_count>& sphere) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (sphere[first] != no_cell && values[id][i] == sphere[id]) continue;
      const T dx = values[x][i] - sphere[x];
      const T dy = values[y][i] - sphere[y];
      const T dz = values[z][i] - sphere[z];
      const T reach = 1 / values[curvature][i] + 1 / sphere[curvature];
      if (dx * dx + dy * dy + dz * dz <= reach * reach) return true;
    }
    return false;
  }
};

/// Cells of a square, as far as there are any: those of the spheres that rays may meet.
template <typename T>
struct CellRange {
  T low_first = std::numeric_limits<T>::max();
  T high_first = std::numeric_limits<T>::lowest();
  T low_second = std::numeric_limits<T>::max();
  T high_second = std::numeric_limits<T>::lowest();
  bool is_known = true;

  /// Those around a ray from the eye in the square's axes. It passes a sphere that it meets between
  /// the planes above and below them all, at most half a cell away.
  HWY_INLINE void include(const SimdSquare<T>& square, const Triple<T>& slope) {
    constexpr T reach = T(0.501);
    constexpr T far_away = 1e5;  // from there on cells have no exact coordinates
    for (const T height : {T(0.5), T(-0.5)}) {
      const T t = (height - square.eye.y) / slope.y;
      is_known &= t >= 0 && t < far_away;
      const T first_place = square.eye.x + t * slope.x;
      const T second_place = square.eye.z + t * slope.z;
      low_first = std::min(low_first, std::ceil(first_place - reach));
      high_first = std::max(high_first, std::floor(first_place + reach));
      low_second = std::min(low_second, std::ceil(second_place - reach));
      high_second = std::max(high_second, std::floor(second_place + reach));
    }
  }
  HWY_INLINE void cut(const SimdSquare<T>& square) {
    low_first = std::max(low_first, square.low_first);
    high_first = std::min(high_first, square.high_first);
    low_second = std::max(low_second, square.low_second);
    high_second = std::min(high_second, square.high_second);
  }
};

/// Adds those of a square that are in the cone around the part whose lower left corner is (x, y).
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void add_spheres_of_square(D d, const EyeRays<D>& eye, const SimdSquare<T>& square,
                                      double x, double y, const PixelCone<T>& cone,
                                      PartSpheres<T>& spheres) {
  using Table = PrimitiveTable<T>;
  const auto zero = hn::Zero(d);
  CellRange<T> cells;
  for (const double right : {0.0, double{part_side}})
    for (const double up : {0.0, double{part_side}}) {
      const auto slope = along_square(square, eye.direction(d, x + right, y + up, zero, zero));
      cells.include(square, {hn::GetLane(slope.x), hn::GetLane(slope.y), hn::GetLane(slope.z)});
    }
  cells.cut(square);
  constexpr T most_cells = 1024;  // a far square's parts show too many, whatever they are
  const T columns = cells.high_first - cells.low_first + 1;
  const T rows = cells.high_second - cells.low_second + 1;
  if (cells.is_known && (columns < 1 || rows < 1)) return;
  if (!cells.is_known || columns * rows > most_cells) {
    spheres.are_all = false;
    return;
  }
  using V = hn::Vec<D>;
  const T unit = square.unit_per_cell;
  const T radius = T(0.5) * unit;
  const T material =
      eye.scene().primitives.row(static_cast<std::size_t>(square.id))[Table::material];
  const V across = hn::Set(d, -square.eye.y * unit);
  const auto from_eye = [&](V cell, T eye_cell) HWY_ATTR {
    return hn::Mul(hn::Sub(cell, hn::Set(d, eye_cell)), hn::Set(d, unit));
  };
  const auto row_count = static_cast<int>(rows);
  const auto column_count = static_cast<int>(columns);
  constexpr auto lanes = static_cast<int>(hn::MaxLanes(D()));
  for (int column = 0; column < column_count; ++column)
    for (int row = 0; row < row_count; row += lanes) {
      const T first = cells.low_first + static_cast<T>(column);
      const V second = hn::Iota(d, cells.low_second + static_cast<T>(row));
      const V3<V> center = from_square(square, V3<V>{from_eye(hn::Set(d, first), square.eye.x),
                                                     across, from_eye(second, square.eye.z)});
      const auto exists = hn::FirstN(d, static_cast<std::size_t>(row_count - row));
      const auto seen = hn::And(exists, cone.may_meet(d, center, hn::Set(d, radius)));
      const V distance = hn::Sqrt(dot(center, center));
      const V r = hn::Set(d, radius);
      alignas(64) T places[5][lanes];
      hn::Store(center.x, d, places[0]);
      hn::Store(center.y, d, places[1]);
      hn::Store(center.z, d, places[2]);
      hn::Store(hn::Mul(hn::Sub(distance, r), hn::Add(distance, r)), d, places[3]);
      hn::Store(second, d, places[4]);
      for (std::uint64_t left = bits_of(d, seen); left != 0; left &= left - 1) {
        const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
        spheres.add({places[0][i], places[1][i], places[2][i], radius * radius, 1 / radius,
                     places[3][i], square.id, material, first, places[4][i]});
      }
    }
}

/// Those of the part whose lower left corner is (x, y), y = 0 at the bottom.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void find_part_spheres(D d, const EyeRays<D>& eye, const PartContents<T>& part, double x,
                                  double y, PartSpheres<T>& spheres) {
  using Table = PrimitiveTable<T>;
  constexpr T no_cell = PartSpheres<T>::no_cell;
  const SimdScene<T>& scene = eye.scene();
  spheres.clear();
  part.for_each_sphere(
      [&](float /*distance*/) { return spheres.are_all; },
      [&](std::uint32_t primitive) {
        const T* const row = scene.primitives.row(primitive);
        spheres.add({row[Table::x], row[Table::y], row[Table::z], row[Table::radius2],
                     row[Table::curvature], row[Table::eye_c], static_cast<T>(primitive),
                     row[Table::material], no_cell, no_cell});
      });
  if (!part.may_show_square()) return;
  const PixelCone<T> cone = cone_around(d, eye, x, y, part_side);
  for (const SimdSquare<T>& square : scene.squares)
    add_spheres_of_square(d, eye, square, x, y, cone, spheres);
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

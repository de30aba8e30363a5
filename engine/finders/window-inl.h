// Where on a light's plane the points of a packet are, all together: few entries of its cells can
// stand before any of them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/finders/light_plane.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// A box around points.
template <typename T>
struct PointBox {
  Triple<T> middle{};
  Triple<T> half{};
};

/// Around the lanes of `active`, at least one.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE PointBox<T> box_around(D d, const V3<V>& points, M active) {
  const V most = hn::Set(d, std::numeric_limits<T>::max());
  PointBox<T> box;
  const auto bound = [&](V values, T& middle, T& half) HWY_ATTR {
    const T low = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(active, values, most)));
    const T high = hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElse(active, values, hn::Neg(most))));
    middle = T(0.5) * low + T(0.5) * high;
    half = T(0.5) * high - T(0.5) * low;
  };
  bound(points.x, box.middle.x, box.half.x);
  bound(points.y, box.middle.y, box.half.y);
  bound(points.z, box.middle.z, box.half.z);
  return box;
}

/// What a box covers of a light's plane, enlarged by what T rounds.
template <typename T>
struct PlaneWindow {
  T u;  ///< its middle
  T v;
  T half_u;  ///< how far it reaches from there
  T half_v;
  T low_w;  ///< towards the light
  T high_w;
  int x_begin, y_begin, x_end, y_end;  ///< of the plane's cells

  HWY_INLINE PlaneWindow(const LightPlane<T>& plane, const PointBox<T>& box) {
    T middle[3];
    T half[3];
    constexpr T rounding = 16 * std::numeric_limits<T>::epsilon();
    for (std::size_t i = 0; i < 3; ++i) {
      const Triple<T>& axis = plane.axes[i];
      const T x = std::abs(axis.x);
      const T y = std::abs(axis.y);
      const T z = std::abs(axis.z);
      const T size =
          x * std::abs(box.middle.x) + y * std::abs(box.middle.y) + z * std::abs(box.middle.z);
      const T reach = x * box.half.x + y * box.half.y + z * box.half.z;
      middle[i] = axis.x * box.middle.x + axis.y * box.middle.y + axis.z * box.middle.z;
      half[i] = reach + rounding * (size + reach) + 2 * plane.noise;
    }
    u = middle[0];
    v = middle[1];
    half_u = half[0];
    half_v = half[1];
    low_w = middle[2] - half[2];
    high_w = middle[2] + half[2];
    const auto cell = [&plane](T offset, int more, int count) HWY_ATTR {
      const T at = offset * plane.cells_per_unit + static_cast<T>(more);
      return static_cast<int>(std::min(std::max(T(0), at), static_cast<T>(count)));
    };
    x_begin = cell(u - half_u - plane.u_low, 0, plane.columns);
    y_begin = cell(v - half_v - plane.v_low, 0, plane.rows);
    x_end = cell(u + half_u - plane.u_low, 1, plane.columns);
    y_end = cell(v + half_v - plane.v_low, 1, plane.rows);
  }

  HWY_INLINE int cell_count() const {
    return std::max(0, x_end - x_begin) * std::max(0, y_end - y_begin);
  }
};

/// Lanes of `lit` that a caster of the window's cells hides. `test` compares casters with points,
/// as occluded_in_cells() has it; test.may_hide(d, get) those with all of the window.
template <class D, class Grid, class Test, class V, std::size_t size, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_in_window(D d, const Grid& grid, const PlaneWindow<T>& window,
                                  const Test& test, const V (&values)[size], M lit) {
  M dark = hn::Lt(values[0], values[0]);
  for (int row = window.y_begin; row < window.y_end; ++row) {
    for (int column = window.x_begin; column < window.x_end; ++column) {
      const auto index =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.plane.columns) +
          static_cast<std::size_t>(column);
      const std::size_t begin = grid.begins[index];
      const std::size_t count = grid.begins[index + 1] - begin;
      const T* const cell = grid.casters.cell(begin);
      for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto next = [&](std::size_t member)
                              HWY_ATTR { return hn::LoadU(d, cell + member * count + i); };
        std::uint64_t left = bits_of(d, hn::And(test.may_hide(d, next), hn::FirstN(d, count - i)));
        if (left == 0) continue;
        for (; left != 0; left &= left - 1) {
          const std::size_t caster = i + hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
          const auto all = [&](std::size_t member)
                               HWY_ATTR { return hn::Set(d, cell[member * count + caster]); };
          dark = hn::Or(dark, test(d, all, values));
        }
        if (hn::AllFalse(d, hn::AndNot(dark, lit))) return lit;
      }
    }
  }
  return hn::And(lit, dark);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

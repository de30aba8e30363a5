// Spheres that pass over the points of a sweep.

#include <hwy/cache_control.h>

#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Some of them as the direction sees them.
template <typename T>
struct PassingDiscs {
  static constexpr std::size_t most = SphereColumns<T>::in_block;
  alignas(64) T u[most], v[most], w[most], radius2[most], id[most];
  alignas(64) T x_low[most], y_low[most], x_high[most], y_high[most];  ///< in cells

  TouchedCells<T> touched(std::size_t i) const {
    return {x_low[i], y_low[i], x_high[i], y_high[i]};
  }
};

/// Puts out the light of what each disc hides in the cells that it touches.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void go_through(D d, SweptPoints<T>& points, const PassingDiscs<T>& discs,
                             PassingPrimitives<T>& visits) {
  using Points = SweptPoints<T>;
  constexpr std::size_t ahead = 8;
  for (std::size_t i = 0; i < visits.count(); ++i) {
    if (PassingPrimitives<T>::template in_vectors<D> && i + ahead < visits.count())
      hwy::Prefetch(points.values.data() +
                    Points::column_count * points.cells[visits.cell(i + ahead)].begin);
    const std::size_t disc = visits.primitive(i);
    const V u = hn::Set(d, discs.u[disc]);
    const V v = hn::Set(d, discs.v[disc]);
    const V w = hn::Set(d, discs.w[disc]);
    const V radius2 = hn::Set(d, discs.radius2[disc]);
    const V id = hn::Set(d, discs.id[disc]);
    const auto hides = [&](const auto& get) HWY_ATTR {
      const V du = hn::Sub(get(Points::column_u), u);
      const V dv = hn::Sub(get(Points::column_v), v);
      const V ahead_of = hn::Mul(hn::Sub(w, get(Points::column_w)), get(Points::column_side));
      return hn::And(hn::And(hn::Gt(ahead_of, hn::Zero(d)), hn::Ne(id, get(Points::column_id))),
                     hn::Le(hn::MulAdd(du, du, hn::Mul(dv, dv)), radius2));
    };
    for_each_part(points, visits.cell(i), discs.touched(disc), discs.w[disc],
                  [&](const auto& cell) HWY_ATTR {
                    ++points.visits;
                    hide_in_cell(d, points, cell, hides);
                  });
  }
  visits.clear();
}

/// All spheres over the points.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void sweep_over(D d, const Geometry<SphereKind, T>& spheres, const BlockOrder& order,
                             SweptPoints<T>& points) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  constexpr std::size_t visits_to_renew = 4;  // for each cell
  constexpr T rounding = 16 * std::numeric_limits<T>::epsilon();
  using Columns = SphereColumns<T>;
  using Discs = PassingDiscs<T>;
  const Columns& columns = spheres.swept;
  const V3<V> axes[3] = {broadcast(d, points.axes[0]), broadcast(d, points.axes[1]),
                         broadcast(d, points.axes[2])};
  const V zero = hn::Zero(d);
  const V before = hn::Set(d, T(-1));
  const V column_count = hn::Set(d, static_cast<T>(points.columns));
  const V row_count = hn::Set(d, static_cast<T>(points.rows));
  using Visits = PassingPrimitives<T>;
  static_assert(Visits::most_cells * Visits::most_cells * Discs::most <= Visits::most);
  Visits visits(points);
  WorthOfAsking worth;
  Discs discs;
  for (std::size_t nth = 0; nth < order.blocks.size(); ++nth) {
    if (nth == order.near_count) {
      worth = {};
      if (points.visits > points.cells.size()) renew_bounds(d, points);
    }
    const std::size_t block = order.blocks[nth];
    const std::size_t begin = block * Discs::most;
    if (worth.asks_about(nth) && worth.leaves_out(!may_hide(points, columns.blocks[block])))
      continue;
    std::uint64_t others = 0;  // than those that are added in vectors
    const auto go = [&]() HWY_ATTR { go_through(d, points, discs, visits); };
    for (std::size_t at = 0; at < Discs::most; at += lanes) {
      const std::size_t i = begin + at;
      if (i >= spheres.count) break;
      const auto get = [&](std::size_t column)
                           HWY_ATTR { return hn::LoadU(d, columns.values[column].data() + i); };
      const V3<V> center{get(Columns::column_x), get(Columns::column_y), get(Columns::column_z)};
      const V u = dot(center, axes[0]);
      const V v = dot(center, axes[1]);
      const V w = dot(center, axes[2]);
      const V reach = hn::MulAdd(get(Columns::column_radius), hn::Set(d, 1 + rounding),
                                 hn::Set(d, points.noise));
      const auto along = [&](V place, T low) HWY_ATTR {
        return hn::Mul(hn::Sub(place, hn::Set(d, low)), hn::Set(d, points.cells_per_unit));
      };
      TouchedCells<V> touched{
          along(hn::Sub(u, reach), points.u_low), along(hn::Sub(v, reach), points.v_low),
          along(hn::Add(u, reach), points.u_low), along(hn::Add(v, reach), points.v_low)};
      const auto touches = hn::And(
          hn::And(hn::Ge(touched.x_high, zero), hn::Ge(touched.y_high, zero)),
          hn::And(hn::FirstN(d, spheres.count - i),
                  hn::And(hn::Lt(touched.x_low, column_count), hn::Lt(touched.y_low, row_count))));
      touched = {hn::Max(touched.x_low, before), hn::Max(touched.y_low, before),
                 hn::Min(touched.x_high, column_count), hn::Min(touched.y_high, row_count)};
      hn::Store(touched.x_low, d, discs.x_low + at);
      hn::Store(touched.y_low, d, discs.y_low + at);
      hn::Store(touched.x_high, d, discs.x_high + at);
      hn::Store(touched.y_high, d, discs.y_high + at);
      hn::Store(u, d, discs.u + at);
      hn::Store(v, d, discs.v + at);
      hn::Store(w, d, discs.w + at);
      hn::Store(get(Columns::column_radius2), d, discs.radius2 + at);
      hn::Store(get(Columns::column_id), d, discs.id + at);
      if constexpr (Visits::template in_vectors<D>)
        others |= bits_of(d, visits.add(d, at, touched, w, touches)) << at;
      else
        others |= bits_of(d, touches) << at;
    }
    for (std::uint64_t left = others; left != 0; left &= left - 1) {
      const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
      visits.add(i, discs.touched(i), discs.w[i], go);
    }
    go();
    if (points.visits > visits_to_renew * points.cells.size()) renew_bounds(d, points);
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

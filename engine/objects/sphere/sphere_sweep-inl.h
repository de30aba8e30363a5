// Spheres that pass over the points of a sweep.

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Some of them as the direction sees them.
template <typename T>
struct PassingDiscs {
  static constexpr std::size_t most = SphereColumns<T>::in_block;
  alignas(64) T u[most], v[most], w[most], radius2[most], id[most];
  alignas(64) T x_low[most], y_low[most], x_high[most], y_high[most];  ///< in cells
};

/// Puts out the light of what each disc hides in the cells that it touches.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void go_through(D d, SweptPoints<T>& points, const PassingDiscs<T>& discs,
                             PassingPrimitives<T>& visits) {
  using Points = SweptPoints<T>;
  for (std::size_t i = 0; i < visits.count(); ++i) {
    const std::size_t disc = visits[i].primitive;
    const V u = hn::Set(d, discs.u[disc]);
    const V v = hn::Set(d, discs.v[disc]);
    const V w = hn::Set(d, discs.w[disc]);
    const V radius2 = hn::Set(d, discs.radius2[disc]);
    const V id = hn::Set(d, discs.id[disc]);
    hide_in_cell(d, points, visits[i].cell, [&](const auto& get) HWY_ATTR {
      const V du = hn::Sub(get(Points::column_u), u);
      const V dv = hn::Sub(get(Points::column_v), v);
      const V ahead = hn::Mul(hn::Sub(w, get(Points::column_w)), get(Points::column_side));
      return hn::And(hn::And(hn::Gt(ahead, hn::Zero(d)), hn::Ne(id, get(Points::column_id))),
                     hn::Le(hn::MulAdd(du, du, hn::Mul(dv, dv)), radius2));
    });
  }
  points.visits += visits.count();
  visits.clear();
}

/// All spheres over the points.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void sweep_over(D d, const Geometry<SphereKind, T>& spheres, SweptPoints<T>& points) {
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
  PassingPrimitives<T> visits(points);
  WorthOfAsking worth;
  Discs discs;
  for (std::size_t begin = 0; begin < spheres.count; begin += Discs::most) {
    const std::size_t block = begin / Discs::most;
    if (worth.asks_about(block) && worth.leaves_out(!may_hide(points, columns.blocks[block])))
      continue;
    std::uint64_t touching = 0;
    for (std::size_t at = 0; at < Discs::most; at += lanes) {
      const std::size_t i = begin + at;
      if (i >= spheres.count) break;
      const auto get = [&](std::size_t column)
                           HWY_ATTR { return hn::LoadU(d, columns.values[column].data() + i); };
      const V3<V> center{get(Columns::column_x), get(Columns::column_y), get(Columns::column_z)};
      const V u = dot(center, axes[0]);
      const V v = dot(center, axes[1]);
      const V reach = hn::MulAdd(get(Columns::column_radius), hn::Set(d, 1 + rounding),
                                 hn::Set(d, points.noise));
      const auto along = [&](V place, T low) HWY_ATTR {
        return hn::Mul(hn::Sub(place, hn::Set(d, low)), hn::Set(d, points.cells_per_unit));
      };
      const V x_low = along(hn::Sub(u, reach), points.u_low);
      const V x_high = along(hn::Add(u, reach), points.u_low);
      const V y_low = along(hn::Sub(v, reach), points.v_low);
      const V y_high = along(hn::Add(v, reach), points.v_low);
      const auto touches =
          hn::And(hn::And(hn::Ge(x_high, zero), hn::Ge(y_high, zero)),
                  hn::And(hn::FirstN(d, spheres.count - i),
                          hn::And(hn::Lt(x_low, column_count), hn::Lt(y_low, row_count))));
      touching |= bits_of(d, touches) << at;
      hn::Store(hn::Max(x_low, before), d, discs.x_low + at);
      hn::Store(hn::Max(y_low, before), d, discs.y_low + at);
      hn::Store(hn::Min(x_high, column_count), d, discs.x_high + at);
      hn::Store(hn::Min(y_high, row_count), d, discs.y_high + at);
      hn::Store(u, d, discs.u + at);
      hn::Store(v, d, discs.v + at);
      hn::Store(dot(center, axes[2]), d, discs.w + at);
      hn::Store(get(Columns::column_radius2), d, discs.radius2 + at);
      hn::Store(get(Columns::column_id), d, discs.id + at);
    }
    const auto go = [&]() HWY_ATTR { go_through(d, points, discs, visits); };
    for (std::uint64_t left = touching; left != 0; left &= left - 1) {
      const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
      visits.add(static_cast<std::uint32_t>(i), discs.x_low[i], discs.y_low[i], discs.x_high[i],
                 discs.y_high[i], discs.w[i], go);
    }
    go();
    if (points.visits > visits_to_renew * points.cells.size()) renew_bounds(d, points);
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

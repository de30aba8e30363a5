// Sweeping a direction of a soft light: its points out of the ledgers, then each kind over them.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "engine/kernel/light_sweep.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Finds the points that look at a place, those of its set or all, towards the ends of the axis at
/// it: those that may be lit. Returns how many, and in `box` what holds them.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE std::size_t find_points(D d, std::span<const LightLedger<T>> ledgers,
                                     std::optional<std::size_t> light_set, bool is_sky,
                                     SweptPoints<T>& points, T (&box)[4]) {
  using Ledger = LightLedger<T>;
  using Points = SweptPoints<T>;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t most = 0;
  for (const Ledger& ledger : ledgers) most += ledger.packet_count();
  auto& found = points.found;
  if (found.packets.size() < most) {
    for (auto& column : found.values) column.resize(most * lanes);
    found.cells.resize(most * lanes);
    found.packets.resize(most);
  }
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const V highest = hn::Set(d, std::numeric_limits<T>::max());
  const V3<V> axis[3] = {broadcast(d, points.axes[0]), broadcast(d, points.axes[1]),
                         broadcast(d, points.axes[2])};
  V low[2] = {highest, highest};
  V high[2] = {hn::Neg(highest), hn::Neg(highest)};
  std::size_t count = 0;
  std::size_t packets = 0;
  std::size_t before = 0;  // packets of other ledgers
  for (const Ledger& ledger : ledgers) {
    for (std::size_t i = 0; i < ledger.packet_count(); ++i) {
      if (light_set && ledger.light_set(i) != *light_set) continue;
      const T* const packet = ledger.packet(i);
      const auto get = [&](std::size_t column)
                           HWY_ATTR { return hn::LoadU(d, packet + column * lanes); };
      const V slope =
          dot(V3<V>{get(Ledger::normal_x), get(Ledger::normal_y), get(Ledger::normal_z)}, axis[2]);
      V side = one;
      if (is_sky) {
        const V cosine = dot(
            V3<V>{get(Ledger::shading_x), get(Ledger::shading_y), get(Ledger::shading_z)}, axis[2]);
        side = hn::IfThenElse(hn::Lt(cosine, zero), hn::Neg(one), one);
      }
      const M lit = hn::And(mask_of(d, ledger.active(i)), hn::Gt(hn::Mul(slope, side), zero));
      if (hn::AllFalse(d, lit)) continue;
      const V3<V> point{get(Ledger::x), get(Ledger::y), get(Ledger::z)};
      const V values[] = {dot(point, axis[0]), dot(point, axis[1]), dot(point, axis[2]),
                          hn::IfThenElseZero(lit, side), get(Ledger::id)};
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = hn::Min(low[k], hn::IfThenElse(lit, values[k], low[k]));
        high[k] = hn::Max(high[k], hn::IfThenElse(lit, values[k], high[k]));
      }
      for (std::size_t k = 0; k < Points::column_count; ++k)
        hn::StoreU(values[k], d, found.values[k].data() + packets * lanes);
      found.packets[packets++] = static_cast<std::uint32_t>(before + i);
      count += count_true(d, lit);
    }
    before += ledger.packet_count();
  }
  found.count = packets * lanes;
  for (std::size_t k = 0; k < 2; ++k) {
    box[k] = hn::GetLane(hn::MinOfLanes(d, low[k]));
    box[2 + k] = hn::GetLane(hn::MaxOfLanes(d, high[k]));
  }
  return count;
}

template <typename T>
void sweep(const PacketScene<T>& scene, const SweptDirection& direction,
           std::span<const LightLedger<T>> ledgers, const SweepOrder& order, SweptPoints<T>& points,
           typename LightLedger<T>::Lanes* dark) {
  const hn::ScalableTag<T> d;
  const PacketSoftLight<T>& soft = scene.soft_lights[direction.light];
  const Triple<T>& towards = soft.directions[direction.place].place;
  const auto axes =
      in_precision<T>(light_axes({double(towards.x), double(towards.y), double(towards.z)}));
  points.axes[0] = axes[0];
  points.axes[1] = axes[1];
  points.axes[2] = towards;
  T box[4];
  std::optional<std::size_t> light_set;
  if (!soft.numbers.is_on_rim(direction.place)) light_set = soft.numbers.set_of(direction.place);
  std::size_t count =
      find_points(d, ledgers, light_set, soft.shape == LightShape::sky, points, box);
  if (count == 0) return;
  // Beside all that passes over them, points see the light.
  T covered[4] = {box[2], box[3], box[0], box[1]};
  scene.geometry.for_each([&]<class Kind>(const Geometry<Kind, T>& geometry) HWY_ATTR {
    if constexpr (Kind::has_light_sweep) {
      if (geometry.finder(RayKind::to_soft_light) != Finder::light_sweep) return;
      for (std::size_t k = 0; k < 2; ++k) {
        const SweptRange<T> range(geometry.swept.box, points.axes[k]);
        covered[k] = std::min(covered[k], range.low);
        covered[2 + k] = std::max(covered[2 + k], range.high);
      }
    }
  });
  for (std::size_t k = 0; k < 2; ++k) {
    box[k] = std::max(box[k], covered[k]);
    box[2 + k] = std::min(box[2 + k], covered[2 + k]);
    if (!(box[k] <= box[2 + k])) return;
  }
  choose_cells(box[0], box[1], box[2], box[3], count, points);
  find_cells(d, points);
  cut_crowded_cells(points);
  sort_into_cells(d, points);
  scene.geometry.for_each([&]<class Kind>(const Geometry<Kind, T>& geometry) HWY_ATTR {
    if constexpr (Kind::has_light_sweep)
      if (geometry.finder(RayKind::to_soft_light) == Finder::light_sweep)
        sweep_over(d, geometry, order[kind_index<Kind>], points);
  });
  tell_dark(points, dark);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

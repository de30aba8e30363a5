// Rays that are traced together, in memory side by side.

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/math/ray.h"
#include "engine/memory/aligned_array.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// A packet of rays that follow others, or come from the eye.
template <class V>
struct Packet {
  RayOrigin<V> from;
  V3<V> direction;
  V weight;     ///< of what they see in their pixels
  V pixel;      ///< its number among those whose rays are queued together
  V followers;  ///< how many rays may still follow, one after another
  V solids;     ///< of how many of these that let rays through they are inside
  LightSet<hn::TFromV<V>> light_set{};  ///< of places on soft lights
};

/// The order that puts the lanes of `mask`, at least one, first. Made once for all values to be
/// stored: Highway's Compress copies a table at each call, and CompressStore is slow on some
/// processors.
template <class D, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE auto compressing_order(D d, M mask) {
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  HWY_ALIGN hwy::MakeSigned<T> order[most_lanes] = {};
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < most_lanes; ++lane) {
    order[count] = static_cast<hwy::MakeSigned<T>>(lane);
    count += bytes[lane / 8] >> (lane % 8) & 1U;
  }
  return hn::SetTableIndices(d, order);
}

/// Rays that are traced together, those that still matter side by side. Where none branch, nothing
/// lets rays through: they are inside of none.
template <typename T, bool branch>
class RayBatch {
 public:
  /// For so many rays, a multiple of the lanes; with what single rounds off of them if paths are
  /// carried in double.
  RayBatch(std::size_t most, bool has_rests)
      : has_rests_(may_be_inexact<T> && has_rests),
        most_(most),
        stride_(most + 64 / sizeof(T)),
        values_(make_aligned_array<T>(column_count * stride_)) {}

  std::size_t count() const { return count_; }
  void clear() { count_ = 0; }
  bool has_room_for(std::size_t more) const { return count_ + more <= most_; }

  /// Adds the lanes of `mask`, at least one; there must be room for all lanes. `rest` is null where
  /// paths are in T.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add(D d, const Packet<V>& rays, const RayRest<V>* rest, M mask) {
    const auto first_of_mask = compressing_order(d, mask);
    const auto keep = [&](std::size_t column, V values) HWY_ATTR {
      hn::StoreU(hn::TableLookupLanes(values, first_of_mask), d, of_column(column) + count_);
    };
    const auto keep_all = [&](std::size_t column, const V3<V>& values) HWY_ATTR {
      keep(column, values.x);
      keep(column + 1, values.y);
      keep(column + 2, values.z);
    };
    keep_all(0, rays.direction);
    keep_all(3, rays.from.point);
    keep_all(6, rays.from.normal);
    keep_all(9, {rays.from.id, rays.from.u, rays.from.v});
    keep_all(12, {rays.weight, rays.pixel, rays.followers});
    if constexpr (branch) keep(15, rays.solids);
    if (rest != nullptr) {
      keep_all(16, rest->point);
      keep_all(19, rest->direction);
    }
    count_ += count_true(d, mask);
  }

  /// The rays from the i-th on. Lanes that are not `active` hold zeros: kept from becoming indices
  /// or NaN traps.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE Packet<V> packet(D d, std::size_t i, M active, const LightSet<T>& light_set) const {
    const auto at = [&](std::size_t column) HWY_ATTR {
      return hn::IfThenElseZero(active, hn::LoadU(d, of_column(column) + i));
    };
    return {{{at(3), at(4), at(5)}, {at(6), at(7), at(8)}, at(9), at(10), at(11)},
            {at(0), at(1), at(2)},
            at(12),
            at(13),
            at(14),
            branch ? at(15) : hn::Zero(d),
            light_set};
  }

  /// What single rounds off of the rays from the i-th on.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE RayRest<V> rest(D d, std::size_t i, M active) const {
    const auto at = [&](std::size_t column) HWY_ATTR {
      return hn::IfThenElseZero(active, hn::LoadU(d, of_column(column) + i));
    };
    return {{at(16), at(17), at(18)}, {at(19), at(20), at(21)}};
  }

  /// Ray i in all lanes, for trees.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE TreeRays<V> ray(D d, std::size_t i) const {
    const auto at = [&](std::size_t column) HWY_ATTR { return hn::Set(d, of_column(column)[i]); };
    const V3<V> direction{at(0), at(1), at(2)};
    const V none = hn::Zero(d);
    return {{{at(3), at(4), at(5)}, {at(6), at(7), at(8)}, at(9), none, none},
            direction,
            {none, none, none},
            basis_across(d, direction)};
  }

  /// Moves others here, for which there must be room.
  void append(RayBatch& others) {
    for (std::size_t i = 0; i < column_count; ++i)
      if (is_kept(i)) std::copy_n(others.of_column(i), others.count_, of_column(i) + count_);
    count_ += std::exchange(others.count_, 0);
  }

 private:
  static constexpr std::size_t column_count = 22;
  HWY_INLINE bool is_kept(std::size_t column) const {
    if (column == 15) return branch;
    return column < 15 || has_rests_;
  }

  HWY_INLINE T* of_column(std::size_t column) { return values_.get() + column * stride_; }
  HWY_INLINE const T* of_column(std::size_t column) const {
    return values_.get() + column * stride_;
  }

  bool has_rests_;
  std::size_t most_;
  std::size_t stride_;  ///< an odd number of cache lines: columns would displace each other
  std::size_t count_ = 0;
  AlignedArray<T> values_;  ///< column by column
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Rays that are traced together, in memory side by side.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/kernel/ray_columns.h"
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
  std::uint8_t bytes[8] = {};
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
  /// Of rays whose paths are carried in double, or not.
  explicit RayBatch(bool is_carried)
      : is_carried_(may_be_inexact<T> && is_carried),
        values_(make_aligned_array<T>(Column::count * ray_stride<T>)) {}

  std::size_t count() const { return count_; }
  void clear() { count_ = 0; }
  bool has_room_for(std::size_t more) const { return count_ + more <= rays_in_batch; }

  /// Adds the lanes of `mask`, at least one, for which there must be room. Where paths are carried
  /// in double, the rays have yet to `turn`: `rays` begin and go as their `way` to the surface does
  /// that they leave; else it is null.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add(D d, const Packet<V>& rays, const WayTo<V>* way, V turn, M mask) {
    static_assert(hn::MaxLanes(D()) * sizeof(T) <= 64, "a packet fits behind the last ray");
    const auto first_of_mask = compressing_order(d, mask);
    const auto keep = [&](std::size_t column, V values) HWY_ATTR {
      hn::StoreU(hn::TableLookupLanes(values, first_of_mask), d, of_column(column) + count_);
    };
    const auto keep_all = [&](std::size_t column, const V3<V>& values) HWY_ATTR {
      keep(column, values.x);
      keep(column + 1, values.y);
      keep(column + 2, values.z);
    };
    keep_all(Column::direction, rays.direction);
    keep_all(Column::point, rays.from.point);
    keep_all(Column::normal, rays.from.normal);
    keep(Column::id, rays.from.id);
    keep(Column::u, rays.from.u);
    keep(Column::v, rays.from.v);
    keep(Column::weight, rays.weight);
    keep(Column::pixel, rays.pixel);
    keep(Column::followers, rays.followers);
    if constexpr (branch) keep(Column::solids, rays.solids);
    if (way != nullptr) {
      keep_all(Column::direction_rest, way->rest.direction);
      keep_all(Column::point_rest, way->rest.point);
      if constexpr (branch) {
        keep(Column::turn, turn);
        keep(Column::side, way->side);
      }
      keep(Column::t, way->t);
      keep(Column::left_id, way->left_id);
      keep_all(Column::left_normal, way->left_normal);
    }
    count_ += count_true(d, mask);
  }

  /// Turns the rays, of a scene whose paths are carried in double.
  void turn(const PacketScene<double>& scene) { turn_in_double(scene, {values_.get(), count_}); }

  /// The rays from the i-th on. Lanes that are not `active` hold zeros: kept from becoming indices
  /// or NaN traps.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE Packet<V> packet(D d, std::size_t i, M active, const LightSet<T>& light_set) const {
    const Lanes<D> at{*this, d, i, active};
    return {{at.vectors(Column::point), at.vectors(Column::normal), at(Column::id), at(Column::u),
             at(Column::v)},
            at.vectors(Column::direction),
            at(Column::weight),
            at(Column::pixel),
            at(Column::followers),
            branch ? at(Column::solids) : hn::Zero(d),
            light_set};
  }

  /// What single rounds off of the rays from the i-th on.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE RayRest<V> rest(D d, std::size_t i, M active) const {
    const Lanes<D> at{*this, d, i, active};
    return {at.vectors(Column::point_rest), at.vectors(Column::direction_rest)};
  }

  /// Ray i in all lanes, for trees.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE TreeRays<V> ray(D d, std::size_t i) const {
    const auto at = [&](std::size_t column) HWY_ATTR { return hn::Set(d, of_column(column)[i]); };
    const V3<V> direction{at(Column::direction), at(Column::direction + 1),
                          at(Column::direction + 2)};
    const V none = hn::Zero(d);
    return {{{at(Column::point), at(Column::point + 1), at(Column::point + 2)},
             {at(Column::normal), at(Column::normal + 1), at(Column::normal + 2)},
             at(Column::id),
             none,
             none},
            direction,
            {none, none, none},
            basis_across(d, direction)};
  }

  /// Moves others here, for which there must be room.
  void append(RayBatch& others) {
    const std::size_t kept = is_carried_ ? Column::count : Column::rests;
    for (std::size_t i = 0; i < kept; ++i)
      std::copy_n(others.of_column(i), others.count_, of_column(i) + count_);
    count_ += std::exchange(others.count_, 0);
  }

 private:
  using Column = RayColumn;

  /// Values of the `active` lanes from the i-th ray on, the others 0.
  template <class D>
  struct Lanes {
    const RayBatch& batch;
    D d;
    std::size_t i;
    hn::Mask<D> active;

    HWY_INLINE hn::Vec<D> operator()(std::size_t column) const {
      return hn::IfThenElseZero(active, hn::LoadU(d, batch.of_column(column) + i));
    }
    HWY_INLINE V3<hn::Vec<D>> vectors(std::size_t first) const {
      return {(*this)(first), (*this)(first + 1), (*this)(first + 2)};
    }
  };

  HWY_INLINE T* of_column(std::size_t column) { return values_.get() + column * ray_stride<T>; }
  HWY_INLINE const T* of_column(std::size_t column) const {
    return values_.get() + column * ray_stride<T>;
  }

  bool is_carried_;
  std::size_t count_ = 0;
  AlignedArray<T> values_;  ///< column by column
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

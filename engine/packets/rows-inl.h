// Values of a table's rows, for packets of which each lane asks for a row of its own.

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The row of a table of Row, whose members are all T, that each lane asks for. Neighbouring pixels
/// mostly show the same thing: then nothing is gathered.
template <class D, class Row>
class Rows {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// `numbers` are those of rows in the lanes of `active`, at least one.
  HWY_INLINE Rows(D d, const Row* table, V numbers, M active) : table_(table) {
    HWY_ALIGN T lanes[hn::MaxLanes(D())];
    hn::Store(numbers, d, lanes);
    const T first = lanes[hn::FindFirstTrue(d, active)];
    is_shared_ = hn::AllTrue(d, hn::Or(hn::Not(active), hn::Eq(numbers, hn::Set(d, first))));
    shared_ = table + static_cast<Place>(first);
    places_ = as_places(hn::IfThenElseZero(active, numbers));
  }

  HWY_INLINE V operator()(D d, T Row::*value) const {
    if (HWY_LIKELY(is_shared_)) return hn::Set(d, shared_->*value);
    return column(d, &(table_->*value));
  }
  HWY_INLINE V3<V> operator()(D d, Triple<T> Row::*values) const {
    if (HWY_LIKELY(is_shared_)) return broadcast(d, shared_->*values);
    const Triple<T>& first = table_->*values;
    return {column(d, &first.x), column(d, &first.y), column(d, &first.z)};
  }

  /// The rows of another table that a value of these names, in the lanes of `active`.
  template <class Other>
  HWY_INLINE Rows<D, Other> followed(D d, T Row::*value, const Other* table, M active) const {
    if (HWY_LIKELY(is_shared_))
      return Rows<D, Other>(d, table + static_cast<Place>(shared_->*value));
    return Rows<D, Other>(d, table, column(d, &(table_->*value)), active);
  }

 private:
  template <class, class>
  friend class Rows;

  using Place = std::int32_t;
  using Places = hn::Rebind<Place, D>;
  static constexpr std::size_t block_bytes = 16;
  static constexpr std::size_t in_row = sizeof(Row) / sizeof(T);
  static constexpr std::size_t in_block = block_bytes / sizeof(T);
  static_assert(sizeof(Row) % block_bytes == 0);
  static_assert(sizeof(T) * hn::MaxLanes(D()) >= block_bytes);

  static HWY_INLINE hn::Vec<Places> as_places(V numbers) {
    if constexpr (sizeof(T) == sizeof(Place))
      return hn::ConvertTo(Places(), numbers);
    else
      return hn::DemoteTo(Places(), numbers);
  }

  HWY_INLINE Rows(D, const Row* shared)
      : table_(shared), shared_(shared), places_(hn::Zero(Places())), is_shared_(true) {}

  /// A value of each lane's row; `first` is that of the table's first row. Blocks of 128 bits are
  /// read and transposed, which takes less time than to gather, the more values of a block are
  /// asked for: compilers read it once.
  HWY_INLINE V column(D d, const T* first) const {
    HWY_ALIGN Place places[hn::MaxLanes(D())];
    hn::Store(places_, Places(), places);
    const auto at = static_cast<std::size_t>(first - reinterpret_cast<const T*>(table_)) % in_block;
    const auto of_lanes_from = [&](std::size_t lane) RAYTRACER_INLINE_ATTR {
      return blocks(d, first - at, places + lane);
    };
    if constexpr (in_block == 2) {
      const V even = of_lanes_from(0);
      const V odd = of_lanes_from(1);
      return at == 0 ? hn::InterleaveLower(d, even, odd) : hn::InterleaveUpper(d, even, odd);
    } else {
      const auto interleave = [](auto of, auto a, auto b, bool lower) RAYTRACER_INLINE_ATTR {
        return lower ? hn::InterleaveLower(of, a, b) : hn::InterleaveUpper(of, a, b);
      };
      const hn::Repartition<double, D> pairs;
      const V a = interleave(d, of_lanes_from(0), of_lanes_from(1), at < 2);
      const V b = interleave(d, of_lanes_from(2), of_lanes_from(3), at < 2);
      return hn::BitCast(
          d, interleave(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b), at % 2 == 0));
    }
  }

  /// Side by side, the blocks of places 0, n, 2 n and so on, n being the values in a block.
  template <class Part>
  static HWY_INLINE hn::Vec<Part> blocks(Part part, const T* block, const Place* places) {
    if constexpr (hn::MaxLanes(Part()) == in_block) {
      return hn::LoadU(part, block + static_cast<std::size_t>(*places) * in_row);
    } else {
      const hn::Half<Part> half;
      return hn::Combine(part, blocks(half, block, places + hn::MaxLanes(half)),
                         blocks(half, block, places));
    }
  }

  const Row* table_;
  const Row* shared_;
  hn::Vec<Places> places_;
  bool is_shared_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

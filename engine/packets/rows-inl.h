// Values of a table's rows, for packets of which each lane asks for a row of its own.

#include <bit>
#include <cstddef>

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
    shared_ = table + static_cast<std::size_t>(first);
    constexpr std::size_t values_in_row = sizeof(Row) / sizeof(T);
    constexpr auto width = static_cast<T>(values_in_row);
    static_assert(std::has_single_bit(sizeof(Row)), "a T holds every product with the width");
    begins_ = hn::ConvertTo(hn::RebindToSigned<D>(),
                            hn::Mul(hn::IfThenElseZero(active, numbers), hn::Set(d, width)));
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
      return Rows<D, Other>(d, table + static_cast<std::size_t>(shared_->*value));
    return Rows<D, Other>(d, table, column(d, &(table_->*value)), active);
  }

 private:
  template <class, class>
  friend class Rows;

  HWY_INLINE Rows(D, const Row* shared)
      : table_(shared),
        shared_(shared),
        begins_(hn::Zero(hn::RebindToSigned<D>())),
        is_shared_(true) {}

  /// A value of each lane's row; `first` is that of the table's first row. Blocks of 128 bits are
  /// read and transposed, which takes less time than to gather, the more values of a block are
  /// asked for: compilers read it once.
  HWY_INLINE V column(D d, const T* first) const {
    using Places = hwy::MakeSigned<T>;
    constexpr std::size_t in_block = 16 / sizeof(T);
    static_assert(sizeof(Row) % 16 == 0);
    HWY_ALIGN Places places[hn::MaxLanes(D())];
    hn::Store(begins_, hn::RebindToSigned<D>(), places);
    const auto at = static_cast<std::size_t>(first - reinterpret_cast<const T*>(table_)) % in_block;
    const T* const block = first - at;
    if constexpr (in_block == 2) {
      const V a = blocks(d, block, places);
      const V b = blocks(d, block, places + 1);
      return at == 0 ? hn::InterleaveLower(d, a, b) : hn::InterleaveUpper(d, a, b);
    } else {
      const hn::Repartition<double, D> pairs;
      const V a = blocks(d, block, places);
      const V b = blocks(d, block, places + 1);
      const V c = blocks(d, block, places + 2);
      const V e = blocks(d, block, places + 3);
      const auto of_both = [&](V low, V high) HWY_ATTR {
        const auto x = hn::BitCast(pairs, low);
        const auto y = hn::BitCast(pairs, high);
        return hn::BitCast(
            d, at % 2 == 0 ? hn::InterleaveLower(pairs, x, y) : hn::InterleaveUpper(pairs, x, y));
      };
      if (at < 2) return of_both(hn::InterleaveLower(d, a, b), hn::InterleaveLower(d, c, e));
      return of_both(hn::InterleaveUpper(d, a, b), hn::InterleaveUpper(d, c, e));
    }
  }

  /// Side by side, blocks of every such row, from the first of `places` on.
  template <class Part>
  static HWY_INLINE hn::Vec<Part> blocks(Part part, const T* block,
                                         const hwy::MakeSigned<T>* places) {
    if constexpr (sizeof(T) * hn::MaxLanes(Part()) <= 16) {
      return hn::LoadU(part, block + *places);
    } else {
      const hn::Half<Part> half;
      return hn::Combine(part, blocks(half, block, places + hn::MaxLanes(half)),
                         blocks(half, block, places));
    }
  }

  const Row* table_;
  const Row* shared_;
  hn::Vec<hn::RebindToSigned<D>> begins_;
  bool is_shared_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

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
    return hn::GatherIndex(d, &(table_->*value), begins_);
  }
  HWY_INLINE V3<V> operator()(D d, Triple<T> Row::*values) const {
    if (HWY_LIKELY(is_shared_)) return broadcast(d, shared_->*values);
    const Triple<T>& first = table_->*values;
    return {hn::GatherIndex(d, &first.x, begins_), hn::GatherIndex(d, &first.y, begins_),
            hn::GatherIndex(d, &first.z, begins_)};
  }

  /// The rows of another table that a value of these names, in the lanes of `active`.
  template <class Other>
  HWY_INLINE Rows<D, Other> followed(D d, T Row::*value, const Other* table, M active) const {
    if (HWY_LIKELY(is_shared_))
      return Rows<D, Other>(d, table + static_cast<std::size_t>(shared_->*value));
    return Rows<D, Other>(d, table, hn::GatherIndex(d, &(table_->*value), begins_), active);
  }

 private:
  template <class, class>
  friend class Rows;

  HWY_INLINE Rows(D, const Row* shared)
      : table_(shared),
        shared_(shared),
        begins_(hn::Zero(hn::RebindToSigned<D>())),
        is_shared_(true) {}

  const Row* table_;
  const Row* shared_;
  hn::Vec<hn::RebindToSigned<D>> begins_;
  bool is_shared_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

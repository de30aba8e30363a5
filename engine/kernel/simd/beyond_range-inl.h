// Which of a block's pixels have had a sample that is clamped or no number.
//
// Looked at before colours are clamped: what is no number would be 1 after it, on most machines.

#include "engine/kernel/beyond_range.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Looks for colours that cannot be shown, at three instructions a packet.
template <class D, typename T = hn::TFromD<D>>
class Highest {
 public:
  explicit HWY_INLINE Highest(D d) : bits_(hn::BitCast(Bits(), hn::Zero(d))) {}

  HWY_INLINE void include(const V3<hn::Vec<D>>& colour) {
    for (const hn::Vec<D>& channel : {colour.x, colour.y, colour.z})
      bits_ = hn::Max(bits_, hn::BitCast(Bits(), channel));
  }

  /// Whether some colour may be: the bits of what is not negative have its order, and those of what
  /// is no number are above all.
  HWY_INLINE bool is_beyond_range(D d) const {
    return !hn::AllFalse(Bits(), hn::Gt(bits_, hn::BitCast(Bits(), hn::Set(d, T(1)))));
  }

 private:
  using Bits = hn::RebindToUnsigned<D>;
  hn::Vec<Bits> bits_;
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
class BlockBeyondRange {
 public:
  /// Notes what cannot be shown of a sample of the block's pixels. `active(place)` says which of a
  /// packet's lanes are in the image.
  template <class Active>
  HWY_INLINE void note(D d, const Block& block, const BlockColours<T>& colours,
                       const Active& active) {
    if (is_empty_)
      for (std::size_t i = 0; i < block_pixels; i += Shape::lanes)
        hn::Store(hn::Zero(d), d, marks_ + i);
    is_empty_ = false;
    const V one = hn::Set(d, T(1));
    for (int packet = 0; packet < Shape::packets; ++packet) {
      const PacketPlace<D> place(packet);
      if (!place.is_in(block)) continue;
      const std::size_t i = static_cast<std::size_t>(packet) * Shape::lanes;
      const V3<V> colour = load(d, colours, i);
      const auto shown =
          hn::And(hn::And(hn::Le(colour.x, one), hn::Le(colour.y, one)), hn::Le(colour.z, one));
      if (hn::AllTrue(d, shown)) continue;
      const auto is_nan =
          hn::Or(hn::Or(hn::IsNaN(colour.x), hn::IsNaN(colour.y)), hn::IsNaN(colour.z));
      const V kind = hn::IfThenElse(is_nan, hn::Set(d, not_a_number), hn::Set(d, clamped));
      const V mark = hn::IfThenElseZero(hn::AndNot(shown, active(place)), kind);
      hn::Store(hn::Max(mark, hn::Load(d, marks_ + i)), d, marks_ + i);
    }
  }

  // One by one: g++ 12 keeps a mask's 16 bits on the stack and counts 64 (hn::CountTrue) where it
  // runs out of registers.
  void add_to(BeyondRange& pixels) const {
    if (is_empty_) return;
    for (const T mark : marks_) {
      pixels.clamped += mark == clamped ? 1 : 0;
      pixels.not_numbers += mark == not_a_number ? 1 : 0;
    }
  }

  /// Whether all samples of the ray's pixel were.
  bool is_number(std::size_t ray) const { return is_empty_ || marks_[ray] != not_a_number; }

 private:
  using Shape = PacketShape<D>;
  static constexpr T clamped = 1;
  static constexpr T not_a_number = 2;

  bool is_empty_ = true;
  alignas(64) T marks_[block_pixels];  ///< 0: none; not set while it is empty
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

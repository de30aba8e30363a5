// Entries that say which of 4 x 4 parts they may touch, many at a time.

#include <cstddef>
#include <cstdint>

#include "engine/finders/binning.h"
#include "engine/packets/padding.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// So many entries are looked through at a time.
inline constexpr std::size_t entries_at_once = 64;

/// Of at most `entries_at_once` entries that touch `parts`: a bit for each that touches one of
/// `wanted`.
HWY_INLINE std::uint64_t entries_that_touch(const Parts* parts, std::size_t count, Parts wanted) {
  const hn::CappedTag<Parts, 16> d;
  constexpr std::size_t lanes = hn::MaxLanes(decltype(d)());
  static_assert(lanes <= packet_padding);
  const auto mask = hn::Set(d, wanted);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; i += lanes) {
    const auto touched = hn::And(hn::LoadU(d, parts + i), mask);
    bits |= bits_of(d, hn::Ne(touched, hn::Zero(d))) << i;
  }
  return count < entries_at_once ? bits & ((std::uint64_t{1} << count) - 1) : bits;
}

/// Which part of its cell each lane is in, as Parts numbers them, of places counted in cells.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V part_at(D d, V column, V row) {
  const V across = hn::Set(d, static_cast<T>(parts_across));
  const auto along = [&](V place) HWY_ATTR {
    return hn::Floor(hn::Mul(hn::Sub(place, hn::Floor(place)), across));
  };
  return hn::MulAdd(along(row), across, along(column));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// What rays from the eye may meet in a part of a block of pixels.

#if defined(RAYTRACER_KERNEL_SIMD_SCREEN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SCREEN_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SCREEN_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SCREEN_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/accel/screen_bins.h"
#include "engine/kernel/simd/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Calls visit(primitive) for those of a block that one of its 4 x 4 parts may show: near to far,
/// while sees(distance) of the next.
template <class Sees, class Visit>
HWY_INLINE void for_each_in_part(const BlockEntries& block, int part, const Sees& sees,
                                 const Visit& visit) {
  const hn::CappedTag<std::uint16_t, 16> d;
  constexpr std::size_t lanes = hn::MaxLanes(decltype(d)());
  constexpr std::size_t word = 64;
  const auto bit = hn::Set(d, static_cast<std::uint16_t>(1U << part));
  const std::size_t count = block.entries.size();
  for (std::size_t begin = 0; begin < count; begin += word) {
    if (!sees(block.entries[begin].nearest)) return;
    const std::size_t here_count = std::min(word, count - begin);
    std::uint64_t here = 0;
    for (std::size_t i = 0; i < here_count; i += lanes)
      here |= bits_of(d, hn::TestBit(hn::LoadU(d, block.parts + begin + i), bit)) << i;
    if (here_count < word) here &= (std::uint64_t{1} << here_count) - 1;
    for (; here != 0; here &= here - 1) {
      const ScreenEntry& entry = block.entries[begin + hwy::Num0BitsBelowLS1Bit_Nonzero64(here)];
      if (!sees(entry.nearest)) return;
      visit(entry.primitive);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

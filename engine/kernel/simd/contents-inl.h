// What rays from the eye may meet in a block of pixels and in its parts.

#if defined(RAYTRACER_KERNEL_SIMD_CONTENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_CONTENTS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_CONTENTS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_CONTENTS_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/accel/screen_bins.h"
#include "engine/kernel/simd/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// So many entries are looked through at a time.
inline constexpr std::size_t entries_at_once = 64;

/// Of a block's entries from `begin` on, at most `entries_at_once`: a bit for each that the part
/// may show.
HWY_INLINE std::uint64_t entries_in_part(const BlockEntries& block, int part, std::size_t begin) {
  const hn::CappedTag<std::uint16_t, 16> d;
  constexpr std::size_t lanes = hn::MaxLanes(decltype(d)());
  const auto bit = hn::Set(d, static_cast<std::uint16_t>(1U << part));
  const std::size_t count = std::min(entries_at_once, block.entries.size() - begin);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; i += lanes)
    bits |= bits_of(d, hn::TestBit(hn::LoadU(d, block.parts + begin + i), bit)) << i;
  return count < entries_at_once ? bits & ((std::uint64_t{1} << count) - 1) : bits;
}

/// Calls visit(primitive) for those of a block that one of its 4 x 4 parts may show: near to far,
/// while sees(distance) of the next; before each `entries_at_once` of the block's reach(first).
template <class Reach, class Sees, class Visit>
HWY_INLINE void for_each_in_part(const BlockEntries& block, int part, const Reach& reach,
                                 const Sees& sees, const Visit& visit) {
  for (std::size_t begin = 0; begin < block.entries.size(); begin += entries_at_once) {
    if (!sees(block.entries[begin].nearest)) return;
    reach(begin);
    for (std::uint64_t here = entries_in_part(block, part, begin); here != 0; here &= here - 1) {
      const ScreenEntry& entry = block.entries[begin + hwy::Num0BitsBelowLS1Bit_Nonzero64(here)];
      if (!sees(entry.nearest)) return;
      visit(entry.primitive);
    }
  }
}

/// What rays from the eye may meet in a block.
///
/// What the entries name lies anywhere in memory, and a ray that waited for each before it knew
/// whether it needs the next would spend most of its time so. It is asked for ahead of the packet
/// that has come farthest, and not at once, because something near may hide nearly all of it:
/// 1,000,000 random spheres trace in 0.45 of the time, 100,000 in 0.7.
template <typename T>
struct BlockContents {
  const SimdScene<T>& scene;
  BlockEntries spheres;
  BlockEntries triangles;
  std::uint32_t square_parts;  ///< parts that may show a square, as in BlockEntries
  std::uint32_t parts;         ///< parts that may show anything
  std::size_t fetched_spheres = 0;
  std::size_t fetched_triangles = 0;

  BlockContents(const SimdScene<T>& of_scene, int column, int row)
      : scene(of_scene),
        spheres(scene.bins.block(column, row)),
        triangles(scene.bins.block_triangles(column, row)),
        square_parts(scene.bins.square_parts(column, row)),
        parts(square_parts) {
    constexpr std::uint32_t all = 0xFFFF;
    // Not in a loop over the two: a processor waits long for a copy of what it has just stored.
    include_parts(spheres);
    include_parts(triangles);
    const bool by_tree = (scene.has_triangles && !scene.has_triangle_bins) ||
                         (scene.has_spheres && !scene.has_sphere_bins);
    if (!scene.planes.empty() || by_tree) parts = all;
  }

  /// Asks the memory for spheres up to some beyond the one at `place`. This and the next are
  /// inline, because g++ takes a call that only fetches for one without effect.
  HWY_INLINE void fetch_spheres(std::size_t place) {
    const std::size_t end = std::min(place + ahead, spheres.entries.size());
    for (; fetched_spheres < end; ++fetched_spheres)
      hwy::Prefetch(scene.primitives.row(spheres.entries[fetched_spheres].primitive));
  }
  /// Likewise for triangles.
  HWY_INLINE void fetch_triangles(std::size_t place) {
    const std::size_t end = std::min(place + ahead, triangles.entries.size());
    for (; fetched_triangles < end; ++fetched_triangles) {
      const std::uint32_t triangle = triangles.entries[fetched_triangles].primitive;
      hwy::Prefetch(&scene.eye_cones[triangle]);
      hwy::Prefetch(&scene.triangles[triangle].plane);
    }
  }

 private:
  void include_parts(const BlockEntries& block) {
    for (std::size_t i = 0; i < block.entries.size(); ++i) parts |= block.parts[i];
  }

  static constexpr std::size_t ahead = 2 * entries_at_once;
};

/// What they may meet in one of its parts.
template <typename T>
struct PartContents {
  BlockContents<T>& block;
  int part;

  /// Calls visit(number) for spheres, near to far, while sees(distance) of the next.
  template <class Sees, class Visit>
  HWY_INLINE void for_each_sphere(const Sees& sees, const Visit& visit) const {
    const auto reach = [&](std::size_t place) HWY_ATTR { block.fetch_spheres(place); };
    for_each_in_part(block.spheres, part, reach, sees, visit);
  }
  /// Likewise visit(index) for triangles.
  template <class Sees, class Visit>
  HWY_INLINE void for_each_triangle(const Sees& sees, const Visit& visit) const {
    const auto reach = [&](std::size_t place) HWY_ATTR { block.fetch_triangles(place); };
    for_each_in_part(block.triangles, part, reach, sees, visit);
  }
  HWY_INLINE bool may_show_square() const { return (block.square_parts >> part & 1U) != 0; }
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

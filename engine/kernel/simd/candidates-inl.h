// Candidates: what rays from the eye may meet in a block of pixels and in its subtiles.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/finders/screen_bins.h"
#include "engine/image/tile.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Of a block's entries from `begin` on, at most `entries_at_once`: a bit for each that the subtile
/// may show.
HWY_INLINE std::uint64_t entries_in_subtile(const BlockEntries& block, int subtile,
                                            std::size_t begin) {
  return entries_that_touch(block.subtiles + begin,
                            std::min(entries_at_once, block.entries.size() - begin),
                            static_cast<Parts>(1U << subtile));
}

/// Calls visit(primitive) for those of a block that one of its 4 x 4 subtiles may show: near to
/// far, while sees(distance) of the next; before each `entries_at_once` of the block's
/// reach(first).
template <class Reach, class Sees, class Visit>
HWY_INLINE void for_each_in_subtile(const BlockEntries& block, int subtile, const Reach& reach,
                                    const Sees& sees, const Visit& visit) {
  for (std::size_t begin = 0; begin < block.entries.size(); begin += entries_at_once) {
    if (!sees(block.entries[begin].nearest)) return;
    reach(begin);
    for (std::uint64_t here = entries_in_subtile(block, subtile, begin); here != 0;
         here &= here - 1) {
      const ScreenEntry& entry = block.entries[begin + hwy::Num0BitsBelowLS1Bit_Nonzero64(here)];
      if (!sees(entry.nearest)) return;
      visit(entry.primitive);
    }
  }
}

/// What rays from the eye may meet in a block, kind by kind.
///
/// What the entries name lies anywhere in memory, and a ray that waited for each before it knew
/// whether it needs the next would spend most of its time so. It is asked for ahead of the packet
/// that has come farthest, and not at once, because something near may hide nearly all of it:
/// 1,000,000 random spheres trace in 0.45 of the time, 100,000 in 0.7.
template <typename T>
struct BlockCandidates {
  const PacketScene<T>& scene;
  std::array<BlockEntries, ObjectKinds::count> entries{};    ///< of those found by bins
  std::array<std::uint32_t, ObjectKinds::count> masks{};     ///< subtiles that may show the others
  std::array<std::size_t, ObjectKinds::count> prefetched{};  ///< of the entries
  std::uint32_t subtiles = 0;                                ///< that may show anything

  BlockCandidates(const PacketScene<T>& of_scene, int column, int row) : scene(of_scene) {
    scene.geometry.for_each([&]<class Geometry>(const Geometry& geometry) {
      using Kind = typename Geometry::Kind;
      if constexpr (Kind::search == Search::own)
        subtiles |= masks[kind_index<Kind>] = geometry.mask.block(column, row);
      else if (geometry.finder(RayKind::from_eye) != Finder::screen_bins)
        subtiles = Tile::all_subtiles;
      else
        include(entries[kind_index<Kind>] = geometry.bins.block(column, row));
    });
  }

  /// Asks the memory for primitives up to some beyond the one at `place`. Inline, because g++ takes
  /// a call that only fetches for one without effect.
  template <class Kind>
  HWY_INLINE void prefetch(std::size_t place) {
    const BlockEntries& block = entries[kind_index<Kind>];
    std::size_t& next = prefetched[kind_index<Kind>];
    const std::size_t end = std::min(place + 2 * entries_at_once, block.entries.size());
    for (; next < end; ++next)
      prefetch_candidate(scene.primitives, std::get<kind_index<Kind>>(scene.geometry.kinds),
                         block.entries[next].primitive);
  }

 private:
  void include(const BlockEntries& block) {
    for (std::size_t i = 0; i < block.entries.size(); ++i) subtiles |= block.subtiles[i];
  }
};

/// What they may meet in one of its subtiles.
template <typename T>
struct SubtileCandidates {
  BlockCandidates<T>& block;
  int subtile;

  /// Calls visit(primitive) for those of a kind found by bins, near to far, while sees(distance) of
  /// the next.
  template <class Kind, class Sees, class Visit>
  HWY_INLINE void for_each(const Sees& sees, const Visit& visit) const {
    const auto reach = [&](std::size_t place) HWY_ATTR { block.template prefetch<Kind>(place); };
    for_each_in_subtile(block.entries[kind_index<Kind>], subtile, reach, sees, visit);
  }
  /// Whether it may show any of a kind that finds its own parts.
  template <class Kind>
  HWY_INLINE bool may_contain() const {
    return (block.masks[kind_index<Kind>] >> subtile & 1U) != 0;
  }
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

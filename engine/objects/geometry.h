// The primitives of one kind of object as packets of rays read them, with what finds them.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/finders/finder.h"
#include "engine/finders/primitive_tree.h"
#include "engine/finders/screen_bins.h"
#include "engine/memory/page_allocator.h"
#include "engine/objects/packet_kind.h"

namespace raytracer {

template <class Kind_, typename T>
struct Geometry {
  using Kind = Kind_;
  using Layout = PacketLayout<Kind, T>;

  FinderRow finders{};
  std::size_t count = 0;
  bool transmits = false;  ///< light comes through some
  /// It does not through others: what hides lights is in PacketScene's `opaque` and `transmitting`.
  bool is_split = false;
  LargeArray<typename Layout::Item> items;         ///< where rays or lists look at them
  ScreenBins bins;                                 ///< for rays from the eye
  ScreenMask mask;                                 ///< likewise, of a kind that finds its own parts
  PacketTree<typename Layout::Block> tree;         ///< empty where nothing needs it
  typename Layout::EyeView eye{};                  ///< as the eye sees them
  typename Layout::Swept swept{};                  ///< as they pass over the points of a sweep
  std::vector<typename Layout::LightView> lights;  ///< as each light sees them

  Finder finder(RayKind rays) const { return finder_of(finders, rays); }
};

}  // namespace raytracer

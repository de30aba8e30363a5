// How a kind of object lies in memory for packets of rays: values in the kernels' precision T, as
// structures and as columns. Each kind specializes PacketLayout in its packets.h; there is a
// concept for each piece, and a kind that is listed in objects/packets.h and lacks one does not
// compile.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/finders/finder.h"
#include "engine/finders/primitive_tree.h"  // IWYU pragma: export
#include "engine/lights/light_kind.h"
#include "engine/math/triple.h"  // IWYU pragma: export
#include "engine/objects/kind.h"
#include "engine/objects/numbering.h"
#include "engine/packets/primitive_row.h"  // IWYU pragma: export
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// Of kinds that lack one of the layouts.
struct NoLayout {
  std::uint32_t count = 0;
};

/// What kinds that know no better inherit.
struct DefaultLayout {
  using Block = NoLayout;    ///< eight in columns, a leaf of a tree
  using EyeView = NoLayout;  ///< what the eye knows beforehand of all of them
  using Swept = NoLayout;    ///< what passes over the points of a sweep
  /// Whether screen bins name primitives by their numbers; else by their places among the items.
  static constexpr bool bins_name_rows = false;
  /// Whether any rays look at items.
  static bool needs_items(const FinderRow&) { return true; }
};

/// Specialized by each kind of object.
template <class Kind, typename T>
struct PacketLayout;

/// By what rays to a light, packed or of packets, find what is in their way.
template <class Light>
RayKind ray_kind_of(const Light& light) {
  if (light.rays == LightRays::parallel)
    return light.is_direction ? RayKind::to_soft_light : RayKind::to_distant_light;
  return light.rays == LightRays::converging ? RayKind::to_point_light : RayKind::followed;
}

/// One primitive as an Item, for rays that try them one by one and for lists.
template <class Layout, class Primitive>
concept HasItems = requires(const Primitive& p, std::int32_t number, const FinderRow& finders) {
  { Layout::item(p, number) } -> std::same_as<typename Layout::Item>;
  { Layout::needs_items(finders) } -> std::same_as<bool>;
  { Layout::bins_name_rows } -> std::convertible_to<bool>;
};

/// What hits need of one, `place` being that of its item.
template <class Layout, class Primitive, typename T>
concept HasRows = requires(const Primitive& p, std::size_t place) {
  { Layout::row(p, place) } -> std::same_as<PrimitiveRow<T>>;
};

/// Of a kind that trees find: fill() puts one into its place of a Block, and of empty() nothing is
/// met.
template <class Layout, class Primitive>
concept HasBlocks = requires(const Primitive& p, std::int32_t number, std::size_t place,
                             typename Layout::Block& block) {
  Layout::fill(p, number, place, block);
  { Layout::Block::empty() } -> std::same_as<typename Layout::Block>;
};

/// What a light knows beforehand of all of them.
template <class Layout, class Primitive>
concept HasLightViews = requires(std::span<const Primitive> primitives, const PackedLight& light,
                                 const FinderRow& finders, const Numbering& numbers,
                                 WorkerPool& pool) {
  {
    Layout::light_view(primitives, light, finders, numbers, pool)
    } -> std::same_as<typename Layout::LightView>;
};

/// Of a kind that sweeps find: all of them as they pass over points, and the `box` around them.
template <class Layout, class Primitive>
concept HasSwept = requires(std::span<const Primitive> primitives, const Numbering& numbers,
                            WorkerPool& pool, const typename Layout::Swept& swept) {
  { Layout::swept(primitives, numbers, pool) } -> std::same_as<typename Layout::Swept>;
  swept.box;
};

/// What trees find is in blocks.
template <class Kind, class Layout>
concept HasBlocksIfBounded =
    Kind::search != Search::bounded || HasBlocks<Layout, typename Kind::Primitive>;

/// What sweeps find passes over points.
template <class Kind, class Layout>
concept HasSweptIfSwept = !Kind::has_light_sweep || HasSwept<Layout, typename Kind::Primitive>;

template <class Kind, typename T, class Layout = PacketLayout<Kind, T>>
concept HasLayout =
    HasItems<Layout, typename Kind::Primitive> && HasRows<Layout, typename Kind::Primitive, T> &&
    HasLightViews<Layout, typename Kind::Primitive> && HasBlocksIfBounded<Kind, Layout> &&
    HasSweptIfSwept<Kind, Layout>;

template <class Kind>
concept LaidOutKind = HasLayout<Kind, float> && HasLayout<Kind, double>;

/// What a kind may have: what the eye knows beforehand of all of them; else nothing.
template <class Layout, class Primitive>
concept HasEyeView = requires(std::span<const Primitive> primitives, const FinderRow& finders,
                              WorkerPool& pool) {
  { Layout::eye_view(primitives, finders, pool) } -> std::same_as<typename Layout::EyeView>;
};

/// Views of distant lights that may be too large for the caches: how many bytes one takes; else
/// none are fetched ahead.
template <class LightView>
concept HasLargeViews = requires(const LightView& view) {
  { view.bytes() } -> std::same_as<std::size_t>;
};

}  // namespace raytracer

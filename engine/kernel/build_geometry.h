// What finds the primitives of a kind, built as its finders ask.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "engine/kernel/packet_scene.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// The primitives of one kind, and whose threads help with many.
template <class Kind>
struct PrimitivesOf {
  const PackedScene& scene;
  std::span<const typename Kind::Primitive> all;
  WorkerPool& pool;
};

inline bool is_used(Finder finder, const FinderRow& finders) {
  return std::find(finders.begin(), finders.end(), finder) != finders.end();
}

/// What rays, lists or bins look at.
template <class Kind, typename T>
void add_items(const PrimitivesOf<Kind>& primitives, Geometry<Kind, T>& geometry) {
  using Layout = PacketLayout<Kind, T>;
  if (!Layout::needs_items(geometry.finders)) return;
  geometry.items.resize(primitives.all.size());
  for_each_range(primitives.all.size(), primitives.pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      geometry.items[i] =
          Layout::item(primitives.all[i], primitives.scene.numbers(primitives.all[i].id));
  });
}

/// What finds primitives, but for what each light knows of them.
template <class Kind, typename T>
void build_finders(const PrimitivesOf<Kind>& primitives, Geometry<Kind, T>& geometry) {
  using Layout = PacketLayout<Kind, T>;
  const auto& [scene, all, pool] = primitives;
  if constexpr (Kind::search == Search::own)
    if (geometry.finder(RayKind::from_eye) != Finder::none)
      geometry.mask = build_screen_mask(scene.view, all);
  if constexpr (Kind::search == Search::bounded) {
    if (is_used(Finder::screen_bins, geometry.finders))
      geometry.bins = build_screen_bins(
          scene.view, all,
          [&primitives](std::size_t i) {
            return Layout::bins_name_rows
                       ? static_cast<std::uint32_t>(primitives.scene.numbers(primitives.all[i].id))
                       : static_cast<std::uint32_t>(i);
          },
          pool);
    if (is_used(Finder::tree, geometry.finders))
      geometry.tree = build_packet_tree<typename Layout::Block>(
          all,
          [&primitives](const auto& primitive, std::size_t place, typename Layout::Block& block) {
            Layout::fill(primitive, primitives.scene.numbers(primitive.id), place, block);
          },
          pool);
  }
  if constexpr (HasEyeView<Layout, typename Kind::Primitive>)
    geometry.eye = Layout::eye_view(all, geometry.finders, pool);
  if constexpr (Kind::has_light_sweep)
    if (is_used(Finder::light_sweep, geometry.finders))
      geometry.swept = Layout::swept(all, scene.numbers, pool);
}

/// What each light knows of the primitives, unless sweeps look along it.
template <class Kind, typename T>
void build_light_views(const PrimitivesOf<Kind>& primitives, const std::vector<PackedLight>& lights,
                       Geometry<Kind, T>& geometry) {
  const auto build = [&](std::size_t light, WorkerPool& pool) {
    geometry.lights[light] = PacketLayout<Kind, T>::light_view(
        primitives.all, lights[light], geometry.finders, primitives.scene.numbers, pool);
  };
  geometry.lights.resize(lights.size());
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (finder_of(geometry.finders, ray_kind_of(lights[i])) != Finder::light_sweep)
      seen.push_back(i);
  // Where it is worth it some views for each thread at a time, and those that are left by all
  // together. Neighbours, as of every other one little is made: the other end of a sky's axis.
  constexpr std::size_t turns = 8;
  const std::size_t threads = primitives.pool.thread_count();
  const bool are_many = seen.size() * primitives.all.size() >= few_items;
  const std::size_t alone = are_many ? seen.size() - seen.size() % threads : 0;
  for_each_chunk(alone, std::min(alone, turns * threads), primitives.pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   WorkerPool own(1);
                   for (std::size_t i = begin; i < end; ++i) build(seen[i], own);
                 });
  for (std::size_t i = alone; i < seen.size(); ++i) build(seen[i], primitives.pool);
}

/// Adds what finds the primitives of a kind, if there are any: `finders` the rays of each kind, and
/// rays to `lights` by what each of these sees of them. `transmits`: light comes through some.
template <class Kind, typename T>
void add_geometry(const PrimitivesOf<Kind>& primitives, const FinderRow& finders, bool transmits,
                  const std::vector<PackedLight>& lights, Geometries<T>& to) {
  if (primitives.all.empty()) return;
  auto& geometry = std::get<kind_index<Kind>>(to.kinds);
  geometry.count = primitives.all.size();
  geometry.finders = finders;
  geometry.transmits = transmits;
  add_items(primitives, geometry);
  build_finders(primitives, geometry);
  build_light_views(primitives, lights, geometry);
}

}  // namespace raytracer

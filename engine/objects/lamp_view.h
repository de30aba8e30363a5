// What a point light sees of items that packets try as they see them from the eye.
//
// A light is another eye: what stands before a point is met by the ray from the light to it, and of
// an item relative to the light that is as exact near the light as it is far off. From the point,
// what an occluder is rounded by would be magnified with its shadow.
#pragma once

#include <cstddef>
#include <span>

#include "engine/finders/point_grid.h"
#include "engine/lights/light_kind.h"
#include "engine/memory/page_allocator.h"
#include "engine/objects/numbering.h"

namespace raytracer {

/// Of kinds whose layouts have items.
template <typename Item, typename T>
struct LampView {
  LargeArray<Item> seen;  ///< relative to the light; none if it is far from all of them
  PointLists<T> lists;    ///< where there are many
};

/// Nothing where a tree finds them.
template <typename Layout, typename T, typename Primitive>
LampView<typename Layout::Item, T> lamp_view(std::span<const Primitive> primitives,
                                             const Vec3& light, Finder finder,
                                             const Numbering& numbers, WorkerPool& pool) {
  LampView<typename Layout::Item, T> view;
  if (finder == Finder::tree) return view;
  const double reach = reach_of(primitives, pool);
  if (!is_far_light(light, reach)) {
    view.seen.resize(primitives.size());
    for_each_range(primitives.size(), pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        view.seen[i] = Layout::item(seen_from(primitives[i], light), numbers(primitives[i].id));
    });
  }
  if (finder == Finder::point_grid)
    view.lists = build_point_lists<T>(light, primitives, reach, pool);
  return view;
}

}  // namespace raytracer

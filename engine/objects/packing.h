// A document's objects on their way into frame coordinates.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "engine/math/frame.h"
#include "engine/memory/page_allocator.h"
#include "engine/parallel/chunks.h"

namespace raytracer {

/// Where an object's primitives are appended.
template <typename Primitive>
struct Packing {
  const Frame& frame;
  WorkerPool* pool;      ///< whose threads help with many, if there is one
  std::uint32_t object;  ///< its place in the document
  LargeArray<Primitive>& primitives;
  double& lost;  ///< counts those that the frame cannot carry, which are left out

  void add(const Primitive& primitive, bool is_carried) {
    if (is_carried)
      primitives.push_back(primitive);
    else
      lost += 1;
  }

  /// Appends make(i) of all items but those that `is_left_out`, of which count as lost those that
  /// are `too_small`. All three are called from several threads.
  template <typename Make, typename IsLeftOut, typename TooSmall>
  void add_all(std::size_t count, const Make& make, const IsLeftOut& is_left_out,
               const TooSmall& too_small) {
    const std::size_t first = primitives.size();
    primitives.resize(first + count);
    std::atomic<bool> leaves_some_out{false};
    for_each_range(count, pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        primitives[first + i] = make(i);
        if (is_left_out(primitives[first + i]))
          leaves_some_out.store(true, std::memory_order_relaxed);
      }
    });
    if (!leaves_some_out) return;
    const auto begin = primitives.begin() + static_cast<std::ptrdiff_t>(first);
    lost += static_cast<double>(std::count_if(begin, primitives.end(), too_small));
    primitives.erase(std::remove_if(begin, primitives.end(), is_left_out), primitives.end());
  }
};

}  // namespace raytracer

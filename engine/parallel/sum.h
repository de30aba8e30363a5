// Sums over many items that do not depend on who adds them up.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/parallel/chunks.h"

namespace raytracer {

/// What add(begin, end, sum) makes of the ranges of 0 ... count, each in a Sum of its own, and
/// these added up in their order by include(). The ranges are the same whatever the number of
/// threads: so is the sum, to the last bit. add() is called from several threads, those of `pool`
/// if there is one.
template <typename Sum, typename Add>
Sum sum_in_parts(std::size_t count, WorkerPool* pool, const Add& add) {
  constexpr std::size_t most_parts = 16;
  const std::size_t part_count = count < few_items ? 1 : most_parts;
  std::vector<Sum> parts(part_count);
  for_each_chunk(count, part_count, pool,
                 [&](std::size_t part, std::size_t begin, std::size_t end) {
                   Sum own;
                   add(begin, end, own);
                   parts[part] = own;
                 });
  for (std::size_t part = 1; part < part_count; ++part) parts[0].include(parts[part]);
  return parts[0];
}

/// The largest of what of(item, largest) gives, which may be as large as what is so far the largest
/// where it is no larger.
template <typename Items, typename Of>
double largest_of(const Items& items, WorkerPool* pool, const Of& of) {
  struct Largest {
    double value = 0;
    void include(const Largest& other) { value = std::max(value, other.value); }
  };
  const auto add = [&](std::size_t begin, std::size_t end, Largest& largest) {
    for (std::size_t i = begin; i < end; ++i) largest.include({of(items[i], largest.value)});
  };
  return sum_in_parts<Largest>(items.size(), pool, add).value;
}

}  // namespace raytracer

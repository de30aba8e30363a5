// Arrays of plain values at the beginning of a cache line, not written before their values are.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <new>
#include <type_traits>

namespace raytracer {

template <typename T>
using AlignedArray = hwy::AlignedFreeUniquePtr<T[]>;

/// Throws std::bad_alloc.
template <typename T>
AlignedArray<T> make_aligned_array(std::size_t count) {
  static_assert(std::is_trivially_destructible_v<T>);
  AlignedArray<T> array = hwy::AllocateAligned<T>(count);
  if (!array) throw std::bad_alloc();
  return array;
}

}  // namespace raytracer

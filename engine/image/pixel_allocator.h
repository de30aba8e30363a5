// Memory for pixels: not written before the pixels are, and few pages where there are many.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace raytracer {

/// Memory for `bytes` at a page's begin, in huge pages where the system has them: an image of
/// 3840 x 2160 has 24,000 small ones, and each costs as much as many pixels when it is first
/// written. Throws std::bad_alloc.
void* allocate_pages(std::size_t bytes);
void free_pages(void* memory);

/// For vectors whose elements are all written after they were made: it leaves them as they are.
template <typename T>
struct PixelAllocator {
  using value_type = T;

  PixelAllocator() = default;
  template <typename U>
  explicit PixelAllocator(const PixelAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t) { free_pages(memory); }

  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const PixelAllocator&, const PixelAllocator&) { return true; }
};

}  // namespace raytracer

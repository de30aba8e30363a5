// Memory for large arrays of plain values: not written before their values are, and in few pages.
//
// A small page costs as much as many values when it is first written, by whoever writes it: a
// picture of 3840 x 2160 has 24,000 of them.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace raytracer {

/// Memory for `bytes`, in huge pages if it fills some and the system has them. Throws
/// std::bad_alloc.
void* allocate_pages(std::size_t bytes);
/// Of so many bytes, as they were asked for.
void free_pages(void* memory, std::size_t bytes);

/// While it lives, huge pages back what is first written of memory that somebody else allocated.
class HugePages {
 public:
  HugePages(void* memory, std::size_t bytes);
  ~HugePages();
  HugePages(const HugePages&) = delete;
  HugePages& operator=(const HugePages&) = delete;

 private:
  void* const memory_;
  const std::size_t bytes_;
};

/// For vectors whose elements are all written after they were made: it leaves them as they are.
template <typename T>
struct PageAllocator {
  using value_type = T;
  static_assert(alignof(T) <= alignof(std::max_align_t));

  PageAllocator() = default;
  template <typename U>
  explicit PageAllocator(const PageAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { free_pages(memory, count * sizeof(T)); }

  template <typename U>
  void construct(U* /*place*/) {
    // Its memory is enough to make one (C++20, implicit object creation).
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
};

/// Small pages are to back what is first written of the memory, or all of it would be made to hold
/// a little.
void avoid_huge_pages(void* memory, std::size_t bytes);

/// A vector that resize() grows by elements that are not set.
template <typename T>
using LargeArray = std::vector<T, PageAllocator<T>>;

template <typename T>
void avoid_huge_pages(LargeArray<T>& array) {
  avoid_huge_pages(array.data(), array.size() * sizeof(T));
}

}  // namespace raytracer

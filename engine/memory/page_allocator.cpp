#include "engine/memory/page_allocator.h"

#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace raytracer {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

}  // namespace

void* allocate_pages(std::size_t bytes) {
  // Not aligned_alloc: before glibc 2.38 it takes no freed memory but what is larger by the
  // alignment, so that a program that allocates the same again and again grows without end.
  void* const memory = std::malloc(bytes);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
#ifdef __linux__
  const std::size_t past_page = reinterpret_cast<std::uintptr_t>(memory) % huge_page;
  const std::size_t before_page = past_page == 0 ? 0 : huge_page - past_page;
  if (bytes > before_page + huge_page)  // a wish: a refusal changes nothing
    madvise(static_cast<char*>(memory) + before_page, (bytes - before_page) / huge_page * huge_page,
            MADV_HUGEPAGE);
#endif
  return memory;
}

void free_pages(void* memory) { std::free(memory); }

}  // namespace raytracer

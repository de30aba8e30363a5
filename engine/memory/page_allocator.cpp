#include "engine/memory/page_allocator.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace raytracer {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

}  // namespace

void* allocate_pages(std::size_t bytes) {
  if (bytes < huge_page) {
    void* const memory = std::malloc(bytes);
    if (memory == nullptr && bytes > 0) throw std::bad_alloc();
    return memory;
  }
  const std::size_t whole_pages = (bytes + huge_page - 1) / huge_page * huge_page;
  void* const memory = std::aligned_alloc(huge_page, whole_pages);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  madvise(memory, whole_pages, MADV_HUGEPAGE);  // a wish: a refusal changes nothing
#endif
  return memory;
}

void free_pages(void* memory) { std::free(memory); }

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int most = 1 << 29;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
#endif
}

}  // namespace raytracer

#include "engine/memory/page_allocator.h"

#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace raytracer {
namespace {

#ifdef __linux__
/// Says how the huge pages within the block are to be backed, if it fills some beside the one that
/// it begins in. A wish: a refusal changes nothing.
void advise_huge_pages(void* memory, std::size_t bytes, int advice) {
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  const std::size_t past_page = reinterpret_cast<std::uintptr_t>(memory) % huge_page;
  const std::size_t before_page = past_page == 0 ? 0 : huge_page - past_page;
  if (bytes > before_page + huge_page)
    madvise(static_cast<char*>(memory) + before_page, (bytes - before_page) / huge_page * huge_page,
            advice);
}
#endif

}  // namespace

void* allocate_pages(std::size_t bytes) {
  // Not aligned_alloc: before glibc 2.38 it takes no freed memory but what is larger by the
  // alignment, so that a program that allocates the same again and again grows without end.
  void* const memory = std::malloc(bytes);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
#ifdef __linux__
  advise_huge_pages(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_pages(void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  // Or the next who gets a few bytes of it takes a huge page.
  advise_huge_pages(memory, bytes, MADV_NOHUGEPAGE);
#endif
  std::free(memory);
}

}  // namespace raytracer

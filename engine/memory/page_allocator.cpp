#include "engine/memory/page_allocator.h"

#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace raytracer {
namespace {

enum class PageSize { small, huge };

/// Says what pages are to back a block where it fills huge ones, beside the one that it begins in.
/// A wish: a refusal changes nothing.
void advise([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
            [[maybe_unused]] PageSize size) {
#ifdef __linux__
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  const std::size_t past_page = reinterpret_cast<std::uintptr_t>(memory) % huge_page;
  const std::size_t before_page = past_page == 0 ? 0 : huge_page - past_page;
  if (bytes > before_page + huge_page)
    madvise(static_cast<char*>(memory) + before_page, (bytes - before_page) / huge_page * huge_page,
            size == PageSize::huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
}

}  // namespace

HugePages::HugePages(void* memory, std::size_t bytes) : memory_(memory), bytes_(bytes) {
  advise(memory, bytes, PageSize::huge);
}

// Or the next who gets a few bytes of it takes a huge page.
HugePages::~HugePages() { advise(memory_, bytes_, PageSize::small); }

void avoid_huge_pages(void* memory, std::size_t bytes) { advise(memory, bytes, PageSize::small); }

void* allocate_pages(std::size_t bytes) {
  // Not aligned_alloc: before glibc 2.38 it takes no freed memory but what is larger by the
  // alignment, so that a program that allocates the same again and again grows without end.
  void* const memory = std::malloc(bytes);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
  advise(memory, bytes, PageSize::huge);
  return memory;
}

void free_pages(void* memory, std::size_t bytes) {
  advise(memory, bytes, PageSize::small);
  std::free(memory);
}

}  // namespace raytracer

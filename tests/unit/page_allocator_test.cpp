// Memory for large arrays: what the system is told of its pages.

#include "engine/memory/page_allocator.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "engine/image/image.h"
#include "tests/process/patience.h"
#include "tests/support/cpu_stopwatch.h"

using namespace raytracer;

namespace {

constexpr std::size_t bytes = std::size_t{8} << 20;

/// What Linux notes of the mapping that holds the address ("VmFlags" in proc(5)); empty if there is
/// none, or nothing to ask.
std::string flags_of(std::uintptr_t address) {
  std::ifstream maps("/proc/self/smaps");
  bool is_here = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-')
      is_here = begin <= address && address < end;
    else if (is_here && line.starts_with("VmFlags:"))
      return line + " ";
  }
  return "";
}

bool wants_huge_pages(std::uintptr_t address) {
  return flags_of(address).find(" hg ") != std::string::npos;
}

}  // namespace

// Who gets a few bytes of what was freed would take a huge page for them, and a server grow.
TEST(PageAllocator, takes_the_wish_for_huge_pages_back_with_the_memory) {
  // From the second time on glibc keeps so large a block, as other allocators do.
  free_pages(allocate_pages(bytes), bytes);
  void* const memory = allocate_pages(bytes);
  const LargeArray<char> behind(1000);
  const auto middle = reinterpret_cast<std::uintptr_t>(memory) + bytes / 2;
  const bool were_wanted = wants_huge_pages(middle);
  free_pages(memory, bytes);
  if (!were_wanted) GTEST_SKIP() << "there are no huge pages to ask for";
  EXPECT_FALSE(wants_huge_pages(middle)) << flags_of(middle);
}

// Below -O2 g++ has a vector of another allocator than its own walk over what there is nothing to
// destroy of.
TEST(PageAllocator, picture_is_given_back_without_a_look_at_its_values) {
  // As sanitizers' and debugging builds are: there the walk takes 95 to 870 ms, and nobody minds.
  if (!test::speed_counts) GTEST_SKIP() << "the engine is compiled below -O2 here";
  auto picture = std::make_unique<ByteImage>(10'000, 5'000);
  const test::CpuStopwatch watch;
  picture.reset();
  EXPECT_LT(watch.elapsed_ms(), 10);
}

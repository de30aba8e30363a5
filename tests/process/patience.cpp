#include "tests/process/patience.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace raytracer::test {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

/// What programs do most: operations that wait for each other, and pages used for the first time,
/// which virtual machines may take long to give.
Milliseconds work() {
  constexpr int operations = 1'000'000;
  constexpr std::size_t pages = 64;
  constexpr std::size_t page_bytes = 4096;
  const auto begin = Clock::now();
  void* const memory =
      mmap(nullptr, pages * page_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return Milliseconds(0);
  auto* const bytes = static_cast<volatile unsigned char*>(memory);
  std::uint64_t state = 1;  // of D. Knuth's generator (MMIX)
  for (int i = 0; i < operations; ++i) state = state * 6364136223846793005U + 1442695040888963407U;
  for (std::size_t page = 0; page < pages; ++page)
    bytes[page * page_bytes] = static_cast<unsigned char>(state >> 56);
  munmap(memory, pages * page_bytes);
  return Clock::now() - begin;
}

/// The shortest of some tries: the others were interrupted.
double slowness_of_machine() {
  constexpr Milliseconds ordinary{1.5};  // four cycles an operation, at 3 GHz, and the pages
  Milliseconds shortest = work();
  for (int i = 1; i < 3; ++i) shortest = std::min(shortest, work());
  return std::max(shortest / ordinary, 1.0);
}

}  // namespace

double slowness() {
  static const double measured = RAYTRACER_TEST_SLOWNESS * slowness_of_machine();
  return measured;
}

bool speed_counts() {
  constexpr double still_ordinary = 2;
  return slowness() < still_ordinary;
}

std::chrono::milliseconds patience(std::chrono::milliseconds limit) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(limit * slowness());
}

}  // namespace raytracer::test

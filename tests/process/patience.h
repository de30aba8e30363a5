// How long tests wait: until something happens, and no longer than a limit that turns a hang into
// a failure.
#pragma once

#include <chrono>
#include <thread>

namespace raytracer::test {

/// True in builds whose speed says something: optimised, without sanitizers.
inline constexpr bool speed_counts = RAYTRACER_TEST_SLOWNESS == 1;

/// `limit` for an optimised build; more for slower ones.
constexpr std::chrono::milliseconds patience(std::chrono::milliseconds limit) {
  return limit * RAYTRACER_TEST_SLOWNESS;
}

/// Asks again and again until `holds()` is true; false if it is not within patience(limit).
template <typename Predicate>
bool eventually(Predicate holds,
                std::chrono::milliseconds limit = std::chrono::milliseconds(10'000)) {
  const auto end = std::chrono::steady_clock::now() + patience(limit);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace raytracer::test

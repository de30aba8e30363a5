// How long tests wait: until something happens, and no longer than a limit that turns a hang into
// a failure.
#pragma once

#include <chrono>
#include <thread>

namespace raytracer::test {

/// How many times as long as on an ordinary, quiet machine in an optimised build things take, at
/// least 1: by how the build is, and by what some arithmetic in new memory takes here, measured
/// once.
double slowness();

/// Whether the time that something takes says something about it.
bool speed_counts();

/// `limit` on an ordinary machine; more on slower ones, and in slower builds.
std::chrono::milliseconds patience(std::chrono::milliseconds limit);

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

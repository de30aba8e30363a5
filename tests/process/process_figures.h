// What another process holds of the system: memory, threads, descriptors. From Linux's /proc.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace raytracer::test {

struct ProcessFigures {
  std::int64_t resident_kb = 0;
  std::int64_t peak_kb = 0;  ///< the most that was ever resident
  std::int64_t thread_count = 0;
  std::int64_t descriptor_count = 0;
};

/// Nothing where there is no /proc, or no such process.
std::optional<ProcessFigures> figures_of(pid_t process);

}  // namespace raytracer::test

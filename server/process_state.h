// What the system says about this process, where it does: Linux.
#pragma once

#include <cstdint>
#include <optional>

namespace raytracer {

struct ProcessState {
  std::optional<std::int64_t> resident_bytes;
  std::optional<std::int64_t> thread_count;
};

/// Reads /proc/self/status; nothing is known elsewhere.
ProcessState this_process();

}  // namespace raytracer

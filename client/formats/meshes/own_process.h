// Work on bytes of a stranger by code that was not written against strangers: in a process of its
// own, which may crash, hang or ask for too much without harm to this one.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace raytracer::client {

struct ProcessLimits {
  std::size_t memory_bytes;
  unsigned seconds;
};

/// What `make` returns there. Throws InputError with what it threw, or how the process ended.
std::string in_own_process(const ProcessLimits& limits, const std::function<std::string()>& make);

}  // namespace raytracer::client

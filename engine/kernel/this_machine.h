// What the kernels may count on here.
#pragma once

#include <cstddef>

#include "engine/plan/machine.h"

namespace raytracer {

/// The machine that this process runs on: of the instruction sets that were compiled, the best
/// that it can run, and so many threads.
Machine this_machine(std::size_t thread_count = 1);

}  // namespace raytracer

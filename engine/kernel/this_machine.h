// What the kernels may count on here: which instruction sets they are compiled for, and what this
// machine can run of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/plan/machine.h"

namespace raytracer {

/// What this machine can run of what was compiled, best first. Throws std::runtime_error if it can
/// run none.
std::vector<InstructionSet> supported_instruction_sets();

/// The place of a target's functions in Highway's tables.
std::size_t dispatch_index(std::int64_t target);

/// The machine that this process runs on: of the instruction sets that were compiled, the best
/// that it can run, and so many threads.
Machine this_machine(std::size_t thread_count = 1);

}  // namespace raytracer

// What a plan may count on.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raytracer {

/// One instruction set that was compiled and that the machine can run.
struct InstructionSet {
  std::int64_t target;  ///< Highway's bit for it
  const char* name;     ///< "AVX2"
};

struct Machine {
  InstructionSet instruction_set;
  std::size_t thread_count = 1;
};

/// The machine that this process runs on: of what was compiled, the best that it can run. The
/// kernels define it, because they are what was compiled. It decides nothing but speed how many
/// threads there are.
Machine this_machine(std::size_t thread_count = 1);

}  // namespace raytracer

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
  std::size_t thread_count = 1;  ///< decides nothing but speed
};

}  // namespace raytracer

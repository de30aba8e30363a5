// Where and with what the figures were taken: neither a name nor a path of the machine.
#pragma once

#include <string>

namespace raytracer::measure {

struct Machine {
  std::string processor;  ///< model, as the kernel calls it
  unsigned cores = 0;
  std::string vectors;  ///< the widest instruction set for vectors
  std::string system;   ///< kernel and release
  std::string compiler;
};

Machine describe_machine();

/// Today as 2024-01-31, in UTC.
std::string today();

}  // namespace raytracer::measure

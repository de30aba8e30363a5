#include "engine/kernel/this_machine.h"

#include <hwy/highway.h>

#include <stdexcept>

namespace raytracer {

std::vector<InstructionSet> supported_instruction_sets() {
  std::vector<InstructionSet> sets;
  const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
  for (std::int64_t bit = 1; bit > 0 && bit <= supported; bit <<= 1)
    if ((supported & bit) != 0) sets.push_back({bit, hwy::TargetName(bit)});
  if (sets.empty())
    throw std::runtime_error("this processor is too old: on x86-64 the kernels need SSSE3");
  return sets;
}

std::size_t dispatch_index(std::int64_t target) {
  hwy::ChosenTarget chosen;
  chosen.Update(target);
  return chosen.GetIndex();
}

Machine this_machine(std::size_t thread_count) {
  // Highway asks the processor each time, which of a virtual one takes as long as a small picture.
  static const InstructionSet best = supported_instruction_sets().front();
  return {best, thread_count};
}

}  // namespace raytracer

#include "engine/measure/processor.h"

#if defined(__x86_64__)
#include <cpuid.h>
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <string_view>
#endif

namespace raytracer {

#if defined(__x86_64__)
std::string processor_model() {
  unsigned int a = 0;
  unsigned int b = 0;
  unsigned int c = 0;
  unsigned int d = 0;
  if (__get_cpuid(0, &a, &b, &c, &d) == 0) return {};
  std::array<char, 12> maker{};
  std::memcpy(maker.data(), &b, 4);
  std::memcpy(maker.data() + 4, &d, 4);
  std::memcpy(maker.data() + 8, &c, 4);
  if (__get_cpuid(1, &a, &b, &c, &d) == 0) return {};
  // Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2A, CPUID, leaf 1.
  const unsigned int family = (a >> 8 & 0xF) + (a >> 20 & 0xFF);
  const unsigned int model = (a >> 4 & 0xF) + (a >> 12 & 0xF0);
  return fmt::format("{} {:02x}-{:02x}", std::string_view(maker.data(), maker.size()), family,
                     model);
}
#else
std::string processor_model() { return {}; }
#endif

}  // namespace raytracer

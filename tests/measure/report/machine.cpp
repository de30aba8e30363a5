#include "tests/measure/report/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace raytracer::measure {
namespace {

/// The value of the first line in /proc/cpuinfo that begins with `key`; empty without one.
std::string processor_entry(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind(key, 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

std::string widest_vectors() {
  const std::string flags = ' ' + processor_entry("flags") + ' ';
  if (flags.find(" avx512f ") != std::string::npos) return "AVX-512";
  if (flags.find(" avx2 ") != std::string::npos) return "AVX2";
  if (flags.find(" sse4_1 ") != std::string::npos) return "SSE4.1";
  return "unknown";
}

}  // namespace

Machine describe_machine() {
  utsname system{};
  uname(&system);
  return {.processor = processor_entry("model name"),
          .cores = std::thread::hardware_concurrency(),
          .vectors = widest_vectors(),
          .system = fmt::format("{} {}", system.sysname, system.machine),
#ifdef __clang__
          .compiler = "clang " __clang_version__
#else
          .compiler = "g++ " __VERSION__
#endif
  };
}

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

}  // namespace raytracer::measure

#include "tests/process/process_figures.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace raytracer::test {

std::optional<ProcessFigures> figures_of(pid_t process) {
  const std::filesystem::path folder = "/proc/" + std::to_string(process);
  std::ifstream status(folder / "status");
  ProcessFigures figures;
  for (std::string line; std::getline(status, line);) {
    std::istringstream fields(line);
    std::string name;
    std::int64_t value = 0;
    if (!(fields >> name >> value)) continue;
    if (name == "VmRSS:") figures.resident_kb = value;  // "VmRSS:   5120 kB"
    if (name == "VmHWM:") figures.peak_kb = value;
    if (name == "Threads:") figures.thread_count = value;
  }
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder / "fd", error), end; !error && entry != end;
       entry.increment(error))
    ++figures.descriptor_count;
  if (error || figures.resident_kb == 0) return {};
  return figures;
}

}  // namespace raytracer::test

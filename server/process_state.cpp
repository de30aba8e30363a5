#include "server/process_state.h"

#include <fstream>
#include <sstream>
#include <string>

namespace raytracer {

ProcessState this_process() {
  ProcessState state;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream fields(line);
    std::string name;
    std::int64_t value = 0;
    if (!(fields >> name >> value)) continue;
    if (name == "VmRSS:") state.resident_bytes = value * 1024;  // "VmRSS:   5120 kB"
    if (name == "Threads:") state.thread_count = value;
  }
  return state;
}

}  // namespace raytracer

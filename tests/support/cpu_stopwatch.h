// Processor time that this process has used since it was made: what else the machine does does not
// count. For work of one thread; several threads' times are added.
#pragma once

#include <ctime>

namespace raytracer::test {

class CpuStopwatch {
 public:
  double elapsed_ms() const {
    return 1e3 * static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace raytracer::test

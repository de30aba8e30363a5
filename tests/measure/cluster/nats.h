// A NATS server of a measurement's own, and what processes take of the processor.
#pragma once

#include <sys/types.h>

#include <string>

#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::measure {

/// Milliseconds of the processor that the process has taken so far, all threads.
double processor_ms(pid_t process);

/// On a port and in a folder of its own.
class Nats {
 public:
  /// Throws std::runtime_error with what it said if it does not start.
  Nats();
  const std::string& url() const { return url_; }
  double processor_ms() const { return measure::processor_ms(process_.id()); }

 private:
  const test::TemporaryFolder folder_;
  test::Process process_;
  std::string url_;
};

}  // namespace raytracer::measure

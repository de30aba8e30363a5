// How far a render has come, on one line of standard error that is gone when it is done.
#pragma once

#include <chrono>
#include <string>

namespace raytracer::client {

/// Shows nothing where standard error is no terminal, and nothing of what is done in 0.3 s.
class ProgressBar {
 public:
  ProgressBar();
  /// Erases the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const std::string& what, double fraction);

 private:
  bool on_terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace raytracer::client

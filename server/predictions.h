// Predicted trace times that wait for their render: the newest few, by the scene's digest.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace raytracer {

class Predictions {
 public:
  /// Replaces an earlier prediction for the same scene.
  void add(const std::string& digest, double trace_ms);

  /// Nothing if there is none any more.
  std::optional<double> trace_ms(const std::string& digest) const;

 private:
  static constexpr std::size_t most = 64;
  std::deque<std::pair<std::string, double>> newest_first_;
};

}  // namespace raytracer

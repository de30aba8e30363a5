// What the server counts from its start on: requests, refusals, renders and what their stages took.
// What is true at a moment (who waits, which jobs there are) is asked where it is known; see
// metrics_handler.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/engine.h"
#include "server/exposition.h"
#include "server/lru_cache.h"

namespace raytracer {

/// The parts of a render's time, as Server-Timing names them.
enum class Stage { parse, plan, build, trace, encode };

/// Every member function may be called from any thread.
class Metrics {
 public:
  Metrics();

  /// A request to a route of the table ("GET", "/jobs/{id}"), or to none, was answered.
  void answered(std::string_view method, std::string_view route, int status, double seconds);

  /// A request was refused with this status, of which 413, 429 and 503 are shown.
  void refused(int status);

  /// A render was admitted after `queue_ms`.
  void waited(double queue_ms);

  void took(Stage stage, double ms);

  /// A rendering is done. `digest` says whose, if the same scene may have been planned before.
  void rendered(const RenderReport& report, const std::optional<std::string>& digest);

  /// A render was stopped before it was done, or before it began.
  void cancelled();

  /// The trace time of a scene was predicted: rendered() compares.
  void predicted(const std::optional<std::string>& digest, const Prediction& prediction);

  void write(Exposition& out) const;

 private:
  using RouteKey = std::pair<std::string, std::string>;  ///< method, pattern

  void observe(Stage stage, double ms);  ///< with the mutex held

  mutable std::mutex mutex_;
  std::map<std::pair<RouteKey, int>, std::uint64_t> requests_;
  std::map<RouteKey, Histogram> request_seconds_;
  std::map<int, std::uint64_t> refused_;
  Histogram queue_seconds_;
  std::vector<Histogram> stage_seconds_;
  std::uint64_t renders_ = 0;
  std::uint64_t cancelled_ = 0;
  double pixels_ = 0;
  double samples_ = 0;
  double clamped_pixels_ = 0;
  double nan_pixels_ = 0;
  LruCache<double> predicted_ms_{64};  ///< of the scenes planned last, by digest; one counts 1
  Histogram actual_to_predicted_;
  double predicted_s_ = 0;
  double actual_s_ = 0;
};

}  // namespace raytracer

// How many bytes of bodies, and of the scenes read from them, may be in memory at once.
//
// --max-body bounds one request; without a bound on their sum, as many large bodies as there are
// HTTP threads could take the machine's memory together.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace raytracer {

class BodyBudget {
 public:
  /// `most` bytes in all; a single body always fits if it is no larger.
  explicit BodyBudget(std::int64_t most) : most_(most) {}

  /// Some of the bytes, given back when nobody holds it any more.
  using Reservation = std::shared_ptr<const void>;

  /// Throws HttpError 429 if there is no room now. The reservation must not outlive this.
  Reservation reserve(std::int64_t bytes);

 private:
  const std::int64_t most_;
  std::atomic<std::int64_t> taken_{0};
};

}  // namespace raytracer

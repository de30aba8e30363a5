// How many bytes of bodies, and of the scenes read from them, may be in memory at once.
//
// --max-body bounds one request; without a bound on their sum, as many large bodies as there are
// HTTP threads could take the machine's memory together.
#pragma once

#include <atomic>
#include <cstdint>

namespace raytracer {

class BodyBudget {
 public:
  /// `most` bytes in all; a single body always fits if it is no larger.
  explicit BodyBudget(std::int64_t most) : most_(most) {}

  /// Some of the bytes, given back at the end of its life.
  class Reservation {
   public:
    Reservation() = default;
    Reservation(Reservation&& other) noexcept;
    Reservation& operator=(Reservation&& other) noexcept;
    ~Reservation();

   private:
    friend class BodyBudget;
    Reservation(BodyBudget& memory, std::int64_t bytes) : memory_(&memory), bytes_(bytes) {}
    BodyBudget* memory_ = nullptr;
    std::int64_t bytes_ = 0;
  };

  /// Throws HttpError 429 if there is no room now.
  Reservation reserve(std::int64_t bytes);

 private:
  const std::int64_t most_;
  std::atomic<std::int64_t> taken_{0};
};

}  // namespace raytracer

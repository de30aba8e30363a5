#include "server/body_memory.h"

#include <utility>

#include "server/problem.h"

namespace raytracer {

BodyMemory::Share BodyMemory::take(std::int64_t bytes) {
  std::int64_t taken = taken_;
  do {
    if (bytes > most_ - taken)
      throw Refusal({429,
                     "The bodies of other requests fill the memory for them; try again later",
                     {},
                     {{"Retry-After", "1"}}});
  } while (!taken_.compare_exchange_weak(taken, taken + bytes));
  return {*this, bytes};
}

BodyMemory::Share::Share(Share&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)), bytes_(other.bytes_) {}

BodyMemory::Share& BodyMemory::Share::operator=(Share&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

BodyMemory::Share::~Share() {
  if (memory_) memory_->taken_ -= bytes_;
}

}  // namespace raytracer

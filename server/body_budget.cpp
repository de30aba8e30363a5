#include "server/body_budget.h"

#include <utility>

#include "server/problem.h"

namespace raytracer {

BodyBudget::Reservation BodyBudget::reserve(std::int64_t bytes) {
  std::int64_t taken = taken_;
  do {
    if (bytes > most_ - taken)
      throw HttpError({429,
                       "The bodies of other requests fill the memory for them; try again later",
                       {},
                       {{"Retry-After", "1"}}});
  } while (!taken_.compare_exchange_weak(taken, taken + bytes));
  return {*this, bytes};
}

BodyBudget::Reservation::Reservation(Reservation&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)), bytes_(other.bytes_) {}

BodyBudget::Reservation& BodyBudget::Reservation::operator=(Reservation&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

BodyBudget::Reservation::~Reservation() {
  if (memory_) memory_->taken_ -= bytes_;
}

}  // namespace raytracer

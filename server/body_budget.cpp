#include "server/body_budget.h"

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
  return {this, [this, bytes](const void*) { taken_ -= bytes; }};
}

}  // namespace raytracer

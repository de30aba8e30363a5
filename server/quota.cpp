#include "server/quota.h"

#include "server/problem.h"

namespace raytracer {

Quota::Share Quota::take(std::int64_t amount) {
  std::int64_t taken = taken_;
  do {
    if (amount > most_ - taken) refuse(429, refusal_, {{"Retry-After", "1"}});
  } while (!taken_.compare_exchange_weak(taken, taken + amount));
  return {this, [this, amount](const void*) { taken_ -= amount; }};
}

}  // namespace raytracer

#include "server/quota.h"

#include <string>

#include "server/problem.h"

namespace raytracer {

void Quota::Portion::add(std::int64_t amount) {
  std::int64_t taken = quota_.taken_;
  do {
    if (amount > quota_.most_ - taken)
      refuse(429, quota_.refusal_, {{"Retry-After", std::to_string(quota_.retry_after_s_())}});
  } while (!quota_.taken_.compare_exchange_weak(taken, taken + amount));
  amount_ += amount;
}

Quota::Share Quota::take(std::int64_t amount) {
  auto share = std::make_shared<Portion>(*this);
  share->add(amount);
  return share;
}

}  // namespace raytracer

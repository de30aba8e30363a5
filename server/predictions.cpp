#include "server/predictions.h"

namespace raytracer {

void Predictions::add(const std::string& digest, double trace_ms) {
  std::erase_if(newest_first_, [&](const auto& entry) { return entry.first == digest; });
  newest_first_.emplace_front(digest, trace_ms);
  if (newest_first_.size() > most) newest_first_.pop_back();
}

std::optional<double> Predictions::trace_ms(const std::string& digest) const {
  for (const auto& [known, trace_ms] : newest_first_)
    if (known == digest) return trace_ms;
  return {};
}

}  // namespace raytracer

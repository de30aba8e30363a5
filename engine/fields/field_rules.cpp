#include "engine/fields/field_rules.h"

#include <fmt/format.h>

#include <cmath>

namespace raytracer {

std::string ValueRange::describe() const {
  if (std::isinf(least)) return fmt::format("at most {}", most);
  if (std::isinf(most)) return fmt::format("{} {}", least_excluded ? "above" : "at least", least);
  return fmt::format("{} {} to {}", least_excluded ? "above" : "from", least, most);
}

}  // namespace raytracer

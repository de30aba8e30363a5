#include "tests/measure/report/markdown_table.h"

namespace raytracer::measure {

std::string digits(double value) {
  if (value >= 99.95) return fmt::format("{:.0f}", value);
  if (value >= 9.995) return fmt::format("{:.1f}", value);
  return fmt::format("{:.2f}", value);
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

}  // namespace raytracer::measure

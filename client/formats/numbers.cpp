#include "client/formats/numbers.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace raytracer::client {

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = fast_float::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::size_t> count_of(std::string_view word) {
  std::size_t count = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, count);
  constexpr std::size_t most = std::size_t{1} << 31;
  if (error != std::errc() || stop != end || count > most) return std::nullopt;
  return count;
}

bool is_moderate(double value) {
  constexpr double most = 1e100;
  return std::abs(value) <= most;
}

float as_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -most, most));
}

}  // namespace raytracer::client

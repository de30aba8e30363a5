#include "client/formats/nff/element_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "client/formats/printable.h"

namespace raytracer::client {

void ElementReader::begin(std::string_view usage) {
  usage_ = usage;
  line_ = words_.line();
  words_.advance();
}

double ElementReader::number() {
  const auto value = number_of(words_.next());
  if (!value)
    throw wrong_word(at_end() ? "the file ends where a number is missing"
                              : quoted(words_.next()) + " stands where a number is missing");
  if (!is_moderate(*value) && !immoderate_)
    immoderate_ = wrong_word(quoted(words_.next()) + " is beyond 1e100");
  words_.advance();
  return *value;
}

double ElementReader::number_from_0(std::string_view what) {
  const auto value = number_of(words_.next());
  if (value && *value < 0)
    throw wrong_word(fmt::format("{} is {}, and must not be negative", what, *value));
  return number();
}

int ElementReader::integer_from(int least, std::string_view what) {
  const auto value = number_of(words_.next());
  constexpr int most = std::numeric_limits<int>::max();
  if (value && !(*value >= least && *value <= most && *value == std::trunc(*value)))
    throw wrong_word(fmt::format("{} is {}, and must be an integer from {}", what, *value, least));
  return static_cast<int>(number());
}

model::Triple ElementReader::triple() {
  const double x = number();
  const double y = number();
  return {x, y, number()};
}

model::Triple ElementReader::shares(std::string_view what) {
  model::Triple color{};
  for (double& share : color) {
    const auto value = number_of(words_.next());
    if (value && !(*value >= 0 && *value <= 1))
      throw wrong_word(fmt::format("{} has {}, and takes numbers from 0 to 1", what, *value));
    share = number();
  }
  return color;
}

LineError ElementReader::wrong(std::string_view what) const {
  return {line_, fmt::format("{}; write {}", what, usage_)};
}

LineError ElementReader::wrong_word(std::string_view what) const {
  const std::string begin = words_.line() == line_ ? "" : fmt::format(", from line {} on", line_);
  return {words_.line(), fmt::format("{}; write {}{}", what, usage_, begin)};
}

}  // namespace raytracer::client

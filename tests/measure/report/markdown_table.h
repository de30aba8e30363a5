// Cells and rows of the tables in the reports.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>

namespace raytracer::measure {

/// Three digits that count, without an exponent; two after the point at most.
std::string digits(double value);

/// With two digits after the point.
std::string percent(double share);

/// A row with its end of line.
template <typename... Cells>
std::string row(const Cells&... cells) {
  std::string text = "|";
  (fmt::format_to(std::back_inserter(text), " {} |", cells), ...);
  return text + '\n';
}

}  // namespace raytracer::measure

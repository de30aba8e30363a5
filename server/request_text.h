// Taking texts of requests apart: lists, letter case, numbers, as RFC 9110 and JSON write them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer {

/// Without the spaces and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// ASCII only, whatever the locale.
std::string lower_case(std::string_view text);

/// The parts between separators, trimmed, of a text that outlives them. Separators in quoted
/// strings separate all the same: no value that this service reads contains one.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

/// A JSON number, whatever the locale; nothing for anything else, "nan" and "1e999" included.
std::optional<double> read_double(std::string_view text);

/// The weight that an element's parameters give it (RFC 9110, 12.4.2), 1 if they say none; nothing
/// if it cannot be read.
std::optional<double> weight_of(std::span<const std::string_view> parameters);

/// Decimal digits with an optional "-"; beyond int, the nearest int.
std::optional<int> read_int(std::string_view text);

}  // namespace raytracer

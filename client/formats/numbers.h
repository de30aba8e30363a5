// Numbers as files write them, and the ranges that pictures take.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace raytracer::client {

/// A finite number, as C writes it in decimal; none if the word is something else.
std::optional<double> number_of(std::string_view word);

/// How many of something a file announces; none if the word is no integer from 0 to 2^31.
std::optional<std::size_t> count_of(std::string_view word);

/// A number that a place or a radius may be: beyond 1e100 pictures cannot be computed.
bool is_moderate(double value);

/// The nearest finite one.
float as_float(double value);

}  // namespace raytracer::client

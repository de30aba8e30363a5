// Numbers that are JSON, but that simdjson does not hold: those beyond all doubles, which no scene
// may have, and integers of more than 64 bits, which are doubles as any other.
//
// A text that has some is spelled anew. There simdjson's unsigned integers, those from 2^63 on, are
// places in the list of numbers that no double holds; all other integers so large are doubles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer {

/// Where it stands in the text.
struct LargeNumber {
  std::size_t begin;
  std::size_t size;
  bool is_beyond_doubles;
};

inline constexpr std::uint64_t first_unsigned = std::uint64_t{1} << 63;

/// In order: every number that no double holds, and every integer of 63 bits or more. Expects JSON;
/// finds something harmless in other text.
std::vector<LargeNumber> find_large_numbers(std::string_view text);

/// Each number that no double holds replaced by a 0. All else keeps its place.
std::string with_zeros(std::string_view text, const std::vector<LargeNumber>& numbers);

/// The text as it is said above: first_unsigned + i stands for numbers[i] if no double does.
std::string spelled_anew(std::string_view text, const std::vector<LargeNumber>& numbers);

}  // namespace raytracer

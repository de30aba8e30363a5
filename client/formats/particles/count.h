// A number of things, as a file announces it.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace raytracer::client {

/// Nothing if the word is no integer from 0 to 2^31.
inline std::optional<std::size_t> count_of(std::string_view word) {
  std::size_t count = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, count);
  constexpr std::size_t most = std::size_t{1} << 31;
  if (error != std::errc() || stop != end || count > most) return std::nullopt;
  return count;
}

}  // namespace raytracer::client

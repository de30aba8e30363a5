#include "engine/scene/large_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace raytracer {
namespace {

bool is_long_integer(std::string_view token) {
  constexpr std::size_t digits_of_63_bits = 19;
  return token.size() >= digits_of_63_bits && token.find_first_of(".eE") == std::string_view::npos;
}

}  // namespace

std::vector<LargeNumber> find_large_numbers(std::string_view text) {
  std::vector<LargeNumber> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
    } else if (text[i] == '-' || (text[i] >= '0' && text[i] <= '9')) {
      const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", i), text.size());
      const std::string token(text.substr(i, end - i));
      char* number_end = nullptr;
      const bool is_beyond = std::isinf(std::strtod(token.c_str(), &number_end));
      const auto size = static_cast<std::size_t>(number_end - token.c_str());
      if (is_beyond || is_long_integer(token)) found.push_back({i, size, is_beyond});
      i = end - 1;
    }
  }
  return found;
}

std::string with_zeros(std::string_view text, const std::vector<LargeNumber>& numbers) {
  std::string result(text);
  for (const LargeNumber& number : numbers)
    if (number.is_beyond_doubles)
      result.replace(number.begin, number.size, std::string(number.size - 2, ' ') + "0 ");
  return result;
}

std::string spelled_anew(std::string_view text, const std::vector<LargeNumber>& numbers) {
  std::string result;
  std::size_t copied = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [begin, size, is_beyond] = numbers[i];
    result.append(text, copied, begin - copied);
    if (is_beyond)
      result += std::to_string(first_unsigned + i);
    else
      result.append(text, begin, size).append(".0");
    copied = begin + size;
  }
  return result.append(text, copied);
}

}  // namespace raytracer

#include "server/request_text.h"

#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>

namespace raytracer {
namespace {

/// Like JSON's numbers, but that no digit need follow the point (RFC 9110, 12.4.2).
std::optional<double> read_weight(std::string_view text) {
  if (text == "0." || text == "1.") text.remove_suffix(1);
  return read_double(text);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> read_double(std::string_view text) {
  // The parser would take white space around it, and a zero byte for the end.
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return {};
  const auto value = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (!value.is_number()) return {};
  return value.get<double>();
}

std::optional<double> weight_of(std::span<const std::string_view> parameters) {
  for (const std::string_view parameter : parameters)
    if (lower_case(parameter.substr(0, 2)) == "q=") {
      const std::optional<double> weight = read_weight(parameter.substr(2));
      return weight && *weight >= 0 && *weight <= 1 ? weight : std::nullopt;
    }
  return 1;
}

std::optional<int> read_int(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return {};
  if (error == std::errc::result_out_of_range)
    return text[0] == '-' ? std::numeric_limits<int>::min() : std::numeric_limits<int>::max();
  if (error != std::errc{}) return {};
  return value;
}

}  // namespace raytracer

// Letters and white space as files' formats mean them: those of ASCII, whatever the locale.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace raytracer::client {

constexpr bool is_white_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower_case(c);
  return result;
}

/// Whether the text begins so, in any case; `beginning` is in lower case.
constexpr bool begins_in_any_case(std::string_view text, std::string_view beginning) {
  return text.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), text.begin(),
                    [](char a, char b) { return a == lower_case(b); });
}

/// Whether the text ends so, in any case; `ending` is in lower case.
constexpr bool ends_in_any_case(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() &&
         begins_in_any_case(text.substr(text.size() - ending.size()), ending);
}

}  // namespace raytracer::client

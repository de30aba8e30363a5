#include "engine/scene/syntax_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/scene/limits.h"

namespace raytracer {
namespace {

using nlohmann::json;

/// The error at a byte of the text.
Error not_json(std::string_view text, std::size_t byte, std::string_view reason) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column =
      1 + std::count_if(in_line.begin(), in_line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;  // UTF-8's first bytes
      });
  Error error{ErrorKind::syntax, "",
              fmt::format("not JSON: line {}, column {}: {}", line, column, reason)};
  error.syntax = {line, column, std::string(reason)};
  return error;
}

constexpr std::string_view white_space = " \t\n\r";  // RFC 8259, section 2

/// Whether `byte` closes an object or array behind a comma.
bool follows_comma(std::string_view text, std::size_t byte) {
  if (byte >= text.size() || (text[byte] != '}' && text[byte] != ']')) return false;
  const auto before = text.substr(0, byte).find_last_not_of(white_space);
  return before != std::string_view::npos && text[before] == ',';
}

/// Why the text stops being JSON at `byte`: nlohmann's words, without its own position and numbers
/// and its parser's state, but for two mistakes that it does not name.
std::string_view reason_of(const json::parse_error& error, std::string_view text,
                           std::size_t byte) {
  if (text.find_first_not_of(white_space) == std::string_view::npos) return "nothing is there";
  if (follows_comma(text, byte)) return "a comma too many before the closing bracket";
  const std::string_view what = error.what();
  constexpr std::string_view before_reason = " - ";
  const auto start = what.find(before_reason);
  return start == std::string_view::npos ? what : what.substr(start + before_reason.size());
}

/// nlohmann's callback: throws an Error at what is nested too deep, and lets nothing be kept but
/// what has begun and not ended.
bool watch_depth(int depth, json::parse_event_t event, const json& /*parsed*/) {
  const bool begins_container =
      event == json::parse_event_t::array_start || event == json::parse_event_t::object_start;
  if (begins_container && depth == deepest_nesting) throw nested_too_deep("");
  return begins_container;
}

}  // namespace

Error nested_too_deep(std::string pointer) {
  return {
      ErrorKind::invalid, std::move(pointer),
      fmt::format("nested deeper than {} levels; a scene needs no more than 6", deepest_nesting)};
}

std::optional<Error> find_syntax_error(std::string_view text) {
  try {
    const json nothing = json::parse(text, watch_depth);
  } catch (const json::parse_error& error) {
    const std::size_t byte = error.byte - 1;
    return not_json(text, byte, reason_of(error, text, byte));
  }
  // The parser takes a zero byte for the text's end.
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos) return not_json(text, zero, "a zero byte");
  return {};
}

}  // namespace raytracer

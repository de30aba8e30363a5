#include "engine/scene/syntax_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/scene/limits.h"

namespace raytracer {
namespace {

using nlohmann::json;

/// Line and column, both from 1 and in characters, of a byte in a text.
std::string describe_position(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column =
      1 + std::count_if(in_line.begin(), in_line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;  // UTF-8's first bytes
      });
  return fmt::format("line {}, column {}", line, column);
}

Error not_json(std::string_view text, std::size_t byte, std::string_view reason) {
  return {ErrorKind::syntax, "",
          fmt::format("not JSON: {}: {}", describe_position(text, byte), reason)};
}

/// nlohmann's words behind "syntax error", without its own position and numbers.
std::string_view reason_of(const json::parse_error& error) {
  const std::string_view what = error.what();
  const auto start = what.find("syntax error ");
  return start == std::string_view::npos ? what : what.substr(start);
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
    return not_json(text, error.byte - 1, reason_of(error));
  }
  // The parser takes a zero byte for the text's end.
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos) return not_json(text, zero, "a zero byte");
  return {};
}

}  // namespace raytracer

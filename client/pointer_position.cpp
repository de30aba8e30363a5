// A scanner by hand: nlohmann-json does not say where a value stood. It may trust the text, which
// the server has parsed, but never reads beyond its end.
#include "client/pointer_position.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace raytracer::client {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) { skip_white(); }

  std::size_t at() const { return at_; }
  bool looking_at(char c) const { return at_ < text_.size() && text_[at_] == c; }

  void skip_white() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  /// One character and the white space after it.
  void skip_mark() {
    at_ = std::min(at_ + 1, text_.size());
    skip_white();
  }

  std::string_view skip_string() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    at_ = std::min(at_ + 1, text_.size());
    return text_.substr(begin, at_ - begin);
  }

  void skip_value() {
    int depth = 0;
    do {
      if (looking_at('"')) {
        skip_string();
      } else if (looking_at('{') || looking_at('[')) {
        ++depth;
        ++at_;
      } else if (looking_at('}') || looking_at(']')) {
        --depth;
        ++at_;
      } else if (looking_at(',') || looking_at(':')) {
        ++at_;
      } else {
        at_ = std::min(text_.find_first_of(",:]} \t\r\n", at_), text_.size());
      }
      skip_white();
    } while (depth > 0 && at_ < text_.size());
  }

  /// From an object or an array to its member; stays if there is none.
  void enter(const std::string& token) {
    const std::size_t container = at_;
    const bool object = looking_at('{');
    const char end = object ? '}' : ']';
    if (!object && !looking_at('[')) return;
    skip_mark();
    for (std::size_t index = 0; at_ < text_.size() && !looking_at(end); ++index) {
      std::string key = std::to_string(index);
      if (object) {
        key = nlohmann::json::parse(skip_string(), nullptr, false).dump();
        skip_white();
        skip_mark();  // the colon
      }
      if (key == (object ? nlohmann::json(token).dump() : token)) return;
      skip_value();
      if (looking_at(',')) skip_mark();
    }
    at_ = container;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// A reference token with ~1 and ~0 read as / and ~.
std::string unescaped(std::string_view token) {
  std::string plain;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const bool escape = token[i] == '~' && i + 1 < token.size();
    plain += !escape ? token[i] : token[i + 1] == '1' ? '/' : '~';
    if (escape) ++i;
  }
  return plain;
}

}  // namespace

TextPosition position_of(std::string_view text, std::string_view pointer) {
  Scanner scanner(text);
  while (pointer.starts_with('/')) {
    pointer.remove_prefix(1);
    const std::string_view token = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(token.size());
    scanner.enter(unescaped(token));
  }
  if (scanner.at() >= text.size()) return {};
  TextPosition position{1, 1};
  for (const char c : text.substr(0, scanner.at())) {
    position.column = c == '\n' ? 1 : position.column + 1;
    if (c == '\n') ++position.line;
  }
  return position;
}

}  // namespace raytracer::client

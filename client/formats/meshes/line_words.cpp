#include "client/formats/meshes/line_words.h"

#include <algorithm>
#include <array>

#include "client/formats/ascii.h"
#include "client/formats/numbers.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// What is for certain in a word: one look at a letter, where a large file has a hundred million.
constexpr std::array<bool, 256> plain_letters = [] {
  std::array<bool, 256> letters{};
  for (std::size_t c = '!'; c < letters.size(); ++c) letters[c] = c != '\\';
  return letters;
}();

}  // namespace

LineWords::LineWords(std::string_view text, bool is_obj)
    : text_(without_byte_order_mark(text)),
      is_obj_(is_obj),
      ends_by_return_(text.find('\n') == text.npos) {}

bool LineWords::joins_lines(std::size_t at) const {
  return is_obj_ && text_[at] == '\\' && at + 1 < text_.size() && is_line_end(text_[at + 1]);
}

void LineWords::skip_line_end() {
  if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
  const bool is_counted = ends_by_return_ || text_[at_] == '\n';  // as editors number lines
  ++at_;
  if (is_counted && !at_end()) ++line_;
}

void LineWords::skip_blanks() {
  while (!at_end()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (joins_lines(at_)) {
      ++at_;
      skip_line_end();
    } else {
      return;
    }
  }
}

std::string_view LineWords::next() {
  skip_blanks();
  if (is_obj_ && !at_end() && text_[at_] == '#') {
    while (!at_line_end()) ++at_;
    return {};
  }
  const std::size_t begin = at_;
  for (;;) {
    while (!at_end() && plain_letters[static_cast<unsigned char>(text_[at_])]) ++at_;
    if (at_line_end() || is_blank(text_[at_]) || joins_lines(at_)) break;
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view LineWords::rest() {
  skip_blanks();
  const std::size_t begin = at_;
  while (!at_line_end()) {
    if (joins_lines(at_)) {
      ++at_;
      skip_line_end();
    } else {
      ++at_;
    }
  }
  return text_.substr(begin, at_ - begin);
}

void LineWords::next_line() {
  while (!next().empty()) {
  }
  if (!at_end()) skip_line_end();
}

bool reads_as_number(std::string_view word) {
  if (number_of(word)) return true;
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  if (begins_in_any_case(word, "nan") || begins_in_any_case(word, "inf")) return true;
  const std::size_t digits = std::min(word.find_first_not_of("0123456789."), word.size());
  if (digits == 0 || digits == word.size()) return false;
  const std::string_view rest = word.substr(digits);
  return rest[0] == ',' || rest[0] == '#' || begins_in_any_case(rest, "e-");
}

}  // namespace raytracer::client

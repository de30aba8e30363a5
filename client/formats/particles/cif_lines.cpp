#include "client/formats/particles/cif_lines.h"

#include <algorithm>
#include <string>

#include "client/formats/ascii.h"

namespace raytracer::client {
namespace {

/// What white space and comments separate: tags, values and words such as loop_, quoted or not.
class CifTokens {
 public:
  /// From the beginning of a line on.
  CifTokens(std::string_view text, int line) : text_(text) {
    while (line_ < line && end_ < text_.size()) skip_to(text_.find('\n', end_), 1);
    advance();
  }

  /// As it stands there; empty at the end.
  std::string_view token() const { return token_; }
  bool is_tag() const { return token_.starts_with('_'); }
  /// Where it begins.
  int line() const { return token_line_; }

  void advance() {
    skip_white();
    const std::size_t begin = end_;
    token_line_ = line_;
    if (begin < text_.size()) skip_token();
    token_ = text_.substr(begin, end_ - begin);
  }

 private:
  /// Behind what is `length` long and begins at `found`, or to the end.
  void skip_to(std::size_t found, std::size_t length) {
    const std::size_t begin = end_;
    end_ = found == text_.npos ? text_.size() : found + length;
    const std::string_view skipped = text_.substr(begin, end_ - begin);
    line_ += static_cast<int>(std::count(skipped.begin(), skipped.end(), '\n'));
  }

  void skip_white() {
    while (end_ < text_.size() && (is_white_space(text_[end_]) || text_[end_] == '#'))
      text_[end_] == '#' ? skip_to(text_.find('\n', end_), 0) : skip_to(end_, 1);
  }

  void skip_token() {
    const char first = text_[end_];
    const bool begins_line = end_ == 0 || text_[end_ - 1] == '\n';
    if (first == ';' && begins_line) return skip_to(text_.find("\n;", end_), 2);
    std::size_t last = end_;  // its last character
    if (first == '\'' || first == '"') {
      // One that no white space follows is a part of the value.
      do last = text_.find(first, last + 1);
      while (last != text_.npos && last + 1 < text_.size() && !is_white_space(text_[last + 1]));
    } else {
      while (last + 1 < text_.size() && !is_white_space(text_[last + 1])) ++last;
    }
    skip_to(last, 1);
  }

  std::string_view text_;
  std::string_view token_;
  std::size_t end_ = 0;  ///< of the token
  int line_ = 1;         ///< there
  int token_line_ = 1;
};

}  // namespace

int line_of_value(std::string_view text, const CifTable& table, std::size_t index) {
  CifTokens tokens(text, table.line);
  const auto skip_tag = [&](int column) {
    while (!tokens.token().empty() && table.column(std::string(tokens.token())) != column)
      tokens.advance();
    tokens.advance();
  };
  skip_tag(0);
  if (tokens.is_tag()) {  // a loop: all tags, then all values
    while (tokens.is_tag()) tokens.advance();
    for (; index > 0; --index) tokens.advance();
  } else if (index > 0) {  // pairs of a tag and its value
    skip_tag(static_cast<int>(index));
  }
  return tokens.line();
}

}  // namespace raytracer::client

// The words of a text format: what white space separates, each with its line. From '#' to the end
// of a line is comment.
#pragma once

#include <cstddef>
#include <string_view>

namespace raytracer::client {

class Words {
 public:
  explicit Words(std::string_view text) : text_(text) { advance(); }

  /// The next word; empty at the end of the text.
  std::string_view next() const { return word_; }
  /// Where the next word stands; at the end of the text, where the last one stood.
  int line() const { return line_; }
  bool at_end() const { return word_.empty(); }
  void advance();

 private:
  std::string_view text_;
  std::string_view word_;
  std::size_t end_ = 0;  ///< of the word
  int lines_read_ = 1;
  int line_ = 1;
};

/// What follows the mark with which some programs begin a UTF-8 text.
constexpr std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

}  // namespace raytracer::client

// The words of each line of a text that is held whole, one after the other, without a copy.
#pragma once

#include <cstddef>
#include <string_view>

namespace raytracer::client {

class LineWords {
 public:
  /// With `is_obj` a backslash before a line's end joins the next line, and from a word that begins
  /// with '#' the rest of the line is comment.
  explicit LineWords(std::string_view text, bool is_obj = false);

  /// No line is left.
  bool at_end() const { return at_ == text_.size(); }
  /// The line has no character more.
  bool at_line_end() const { return at_end() || is_line_end(text_[at_]); }
  /// The line has no word more.
  bool has_no_more() {
    skip_blanks();
    return at_line_end();
  }
  /// From 1; of lines that are joined, where it stands. At the end of the text, the last one's.
  int line() const { return line_; }

  /// The line's next word; empty at its end.
  std::string_view next();
  /// All that is left of the line, joined lines too, behind the white space before it.
  std::string_view rest();
  void next_line();

  /// What stands behind the last word.
  std::string_view rest_of_text() const { return text_.substr(at_); }

 private:
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  bool joins_lines(std::size_t at) const;
  void skip_blanks();
  void skip_line_end();

  std::string_view text_;
  bool is_obj_;
  bool ends_by_return_;  ///< all lines, as of old
  std::size_t at_ = 0;
  int line_ = 1;
};

/// Whether assimp reads the word as a number: as C writes it, also without a value (nan, inf and
/// 1.#IND), too small for one, or with a comma for a point.
bool reads_as_number(std::string_view word);

}  // namespace raytracer::client

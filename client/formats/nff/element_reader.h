// The words of one NFF element after the other, as the numbers that it takes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "client/formats/numbers.h"
#include "client/formats/reading.h"
#include "client/formats/words.h"

namespace raytracer::client {

/// Whatever is not as it should be is thrown as a LineError.
class ElementReader {
 public:
  explicit ElementReader(std::string_view text) : words_(text) {}

  bool at_end() const { return words_.at_end(); }
  std::string_view next() const { return words_.next(); }
  int next_line() const { return words_.line(); }
  bool is_number_next() const { return number_of(words_.next()).has_value(); }

  /// Takes the name of an element, which is written like `usage`.
  void begin(std::string_view usage);
  /// Where the element begins.
  int line() const { return line_; }

  /// Takes any word.
  void skip() { words_.advance(); }
  double number();
  double number_from_0(std::string_view what);
  int integer_from(int least, std::string_view what);
  model::Triple triple();
  /// Of a colour.
  model::Triple shares(std::string_view what);

  /// An error in the first number that was too large to stand somewhere; none if all are moderate.
  const std::optional<LineError>& immoderate() const { return immoderate_; }

  /// An error in the element itself, in its first line.
  LineError wrong(std::string_view what) const;
  /// An error in the next word.
  LineError wrong_word(std::string_view what) const;

 private:
  Words words_;
  std::string_view usage_;
  int line_ = 1;
  std::optional<LineError> immoderate_;
};

}  // namespace raytracer::client

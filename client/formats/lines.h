// A text's lines, one at a time, of a source that is never held whole; and the fields of a line.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "client/formats/reading.h"
#include "client/formats/text_source.h"

namespace raytracer::client {

class Lines {
 public:
  /// The source outlives it. Throws InputError as the source does.
  explicit Lines(TextSource& source);

  bool at_end() const { return at_end_; }
  /// Without its end, until advance(); empty at the end of the text.
  std::string_view line() const { return line_; }
  /// Of the line, from 1; at the end of the text, of the last one.
  int number() const { return number_; }
  /// Throws LineError if the next line is longer than a megabyte.
  void advance();
  /// Goes on to a line that has more than white space.
  void skip_blank();

  /// In the line where it stands.
  LineError wrong(std::string_view what) const { return {number_, std::string(what)}; }

 private:
  bool fill();

  TextSource& source_;
  std::unique_ptr<char[]> room_;  ///< for the longest line; untouched behind `end_`
  std::size_t begin_ = 0;         ///< of what is unread in the room
  std::size_t end_ = 0;
  std::string_view line_;
  int number_ = 0;
  bool at_end_ = false;
};

/// What white space separates; replaces the content of `fields`.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// What a separator separates, without white space around it. Of what stands in quotation marks
/// these are taken off, and "" is one. `unquoted` keeps what had to be written anew. False if a
/// quotation mark is not closed.
bool split_quoted(std::string_view line, char separator, std::vector<std::string_view>& fields,
                  std::vector<std::string>& unquoted);

}  // namespace raytracer::client

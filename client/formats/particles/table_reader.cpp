#include "client/formats/particles/table_reader.h"

#include <algorithm>
#include <utility>

#include "client/formats/numbers.h"
#include "client/formats/particles/columns.h"

namespace raytracer::client {
namespace {

/// Whether x, y and z are among the words, whatever stands between them.
bool names_places(std::string_view comment) {
  std::string words(comment);
  for (char& c : words)
    if (c == ',' || c == ';' || c == '"') c = ' ';
  std::vector<std::string_view> names;
  split_fields(words, names);
  const auto is_there = [&](const char* small, const char* large) {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return name == small || name == large; });
  };
  return is_there("x", "X") && is_there("y", "Y") && is_there("z", "Z");
}

/// Its fields: numpy.savetxt writes the header as it is given, whatever separates the numbers.
std::vector<std::string> names_in(std::string_view comment, char separator) {
  std::vector<std::string_view> names;
  std::vector<std::string> unquoted;
  split_fields(comment, names);
  for (const char between : {separator, ',', ';', '\t'}) {
    if (between == ' ' || comment.find(between) == comment.npos) continue;
    if (!split_quoted(comment, between, names, unquoted)) names.clear();
    break;
  }
  return {names.begin(), names.end()};
}

}  // namespace

TableReader::TableReader(std::unique_ptr<TextSource> source, char separator,
                         const ImportOptions& options)
    : source_(std::move(source)), lines_(*source_), separator_(separator), options_(options) {}

void TableReader::skip_comments() {
  for (lines_.skip_blank(); !lines_.at_end() && lines_.line().starts_with('#');
       lines_.skip_blank()) {
    const std::string_view comment = lines_.line().substr(1);
    if (names_places(comment)) {
      comment_ = comment;
      comment_line_ = lines_.number();
    }
    lines_.advance();
  }
}

/// By the first line that is no comment.
void TableReader::find_separator() {
  const auto has = [&](char c) { return lines_.line().find(c) != std::string_view::npos; };
  if (separator_ == ',' && !has(',')) separator_ = ';';
  if (!comment_.empty() && !has(separator_)) separator_ = ' ';  // white space
}

void TableReader::split() {
  if (separator_ == ' ') return split_fields(lines_.line(), fields_);
  if (split_quoted(lines_.line(), separator_, fields_, unquoted_)) return;
  // What stands in quotation marks may go over several lines; the last one has the mark that makes
  // their number even.
  constexpr std::size_t longest = 1 << 20;
  const int first = lines_.number();
  const auto marks = [](std::string_view text) {
    return std::count(text.begin(), text.end(), '"');
  };
  record_ = lines_.line();
  for (auto count = marks(record_); count % 2 != 0; count += marks(lines_.line())) {
    lines_.advance();
    if (lines_.at_end() || record_.size() > longest)
      throw LineError{first, "a quotation mark is not closed"};
    record_.append("\n").append(lines_.line());
  }
  if (!split_quoted(record_, separator_, fields_, unquoted_))
    throw LineError{first, "a quotation mark is not closed"};
}

TableReader::Header TableReader::read_header() {
  const int line = lines_.number();
  split();
  if (std::none_of(fields_.begin(), fields_.end(),
                   [](std::string_view field) { return number_of(field).has_value(); }))
    return {{fields_.begin(), fields_.end()}, line, false};
  std::vector<std::string> names = names_in(comment_, separator_);
  if (names.size() != fields_.size())  // a comment that only speaks of x, y and z is no header
    throw lines_.wrong(
        "a number stands in the first line, which is to name the columns: x, y, z "
        "and so on");
  return {std::move(names), comment_line_, true};
}

std::optional<Particles> TableReader::next_frame() {
  skip_comments();
  find_separator();
  const Header header = read_header();
  Columns columns(header.names, options_, header.line);
  Particles particles;
  const auto add = [&] {
    if (fields_.size() > header.names.size())
      throw lines_.wrong("the line has more fields than the header has names");
    columns.add(fields_, lines_.number(), particles);
  };
  if (header.is_comment) add();
  lines_.advance();
  for (skip_comments(); !lines_.at_end(); skip_comments()) {
    split();
    add();
    lines_.advance();
  }
  if (particles.places.empty()) throw lines_.wrong("the table has a header and no points");
  columns.finish(particles);
  return particles;
}

}  // namespace raytracer::client

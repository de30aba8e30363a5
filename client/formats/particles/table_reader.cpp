#include "client/formats/particles/table_reader.h"

#include <algorithm>

#include "client/formats/words.h"

namespace raytracer::client {

TableReader::TableReader(std::unique_ptr<TextSource> source, char separator, const Wishes& wishes)
    : source_(std::move(source)), lines_(*source_), separator_(separator), color_(wishes.color) {}

void TableReader::split() {
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

std::optional<Particles> TableReader::next_frame() {
  const auto skip_comments = [this] {
    lines_.skip_blank();
    while (!lines_.at_end() && lines_.line().starts_with('#')) {
      lines_.advance();
      lines_.skip_blank();
    }
  };
  skip_comments();
  if (separator_ == ',' && lines_.line().find(',') == std::string_view::npos) separator_ = ';';
  split();
  if (std::any_of(fields_.begin(), fields_.end(),
                  [](std::string_view field) { return number_of(field).has_value(); }))
    throw lines_.wrong(
        "a number stands in the first line, which is to name the columns: x, y, z "
        "and so on");
  Columns columns({fields_.begin(), fields_.end()}, color_, lines_.number());
  const std::size_t width = fields_.size();
  lines_.advance();
  Particles particles;
  for (skip_comments(); !lines_.at_end(); skip_comments()) {
    split();
    if (fields_.size() > width)
      throw lines_.wrong("the line has more fields than the header has names");
    columns.add(fields_, lines_.number(), particles);
    lines_.advance();
  }
  if (particles.places.empty()) throw lines_.wrong("the table has a header and no points");
  columns.finish(particles);
  return particles;
}

}  // namespace raytracer::client

#include "client/formats/particles/table_reader.h"

#include <algorithm>

#include "client/formats/words.h"

namespace raytracer::client {

TableReader::TableReader(std::unique_ptr<TextSource> source, char separator, const Wishes& wishes)
    : source_(std::move(source)), lines_(*source_), separator_(separator), color_(wishes.color) {}

void TableReader::split() {
  if (!split_quoted(lines_.line(), separator_, fields_, unquoted_))
    throw lines_.wrong("a quotation mark is not closed before the line ends");
}

Particles TableReader::next_frame() {
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
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (fields_[0].starts_with(byte_order_mark)) fields_[0].remove_prefix(byte_order_mark.size());
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

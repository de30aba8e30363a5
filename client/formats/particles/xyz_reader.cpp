#include "client/formats/particles/xyz_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "client/formats/numbers.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

/// The value of a key in key=value key="several words"; nothing if it is not there.
std::optional<std::string_view> value_of(std::string_view comment, std::string_view key) {
  for (std::size_t at = comment.find(key); at != comment.npos; at = comment.find(key, at + 1)) {
    const bool begins = at == 0 || comment[at - 1] == ' ' || comment[at - 1] == '\t';
    std::string_view rest = comment.substr(at + key.size());
    if (!begins || !rest.starts_with('=')) continue;
    rest.remove_prefix(1);
    if (rest.starts_with('"')) return rest.substr(1, rest.find('"', 1) - 1);
    return rest.substr(0, rest.find_first_of(" \t"));
  }
  return std::nullopt;
}

/// "species:S:1:pos:R:3" as element x y z. The column that is to give the colours is renamed, too.
std::vector<std::string> names_of(std::string_view properties, int line, std::string& color) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t colon = properties.find(':');
    parts.push_back(properties.substr(0, colon));
    if (colon == properties.npos) break;
    properties.remove_prefix(colon + 1);
  }
  std::vector<std::string> names;
  constexpr std::size_t most = 1000;
  for (std::size_t i = 0; i + 2 < parts.size() && names.size() < most; i += 3) {
    std::size_t count = 0;
    const std::string_view text = parts[i + 2];
    std::from_chars(text.data(), text.data() + text.size(), count);
    if (count < 1 || count > most)
      throw LineError{line, fmt::format("{} is no number of columns; write "
                                        "Properties=species:S:1:pos:R:3 and so on",
                                        quoted(text))};
    if (parts[i] == "pos" && count == 3) {
      names.insert(names.end(), {"x", "y", "z"});
    } else if (parts[i] == "color" && count == 3) {
      names.insert(names.end(), {"r", "g", "b"});
    } else if (parts[i] == "Z" || parts[i] == "species") {
      names.emplace_back("element");
      if (color == parts[i]) color = names.back();
    } else if (count == 1) {
      names.emplace_back(parts[i]);
    } else {
      for (std::size_t k = 1; k <= count; ++k) names.push_back(fmt::format("{}_{}", parts[i], k));
    }
  }
  return names;
}

}  // namespace

XyzReader::XyzReader(std::unique_ptr<TextSource> source, const ImportOptions& options)
    : source_(std::move(source)), lines_(*source_), options_(options) {
  lines_.skip_blank();
}

std::size_t XyzReader::read_count() {
  split_fields(lines_.line(), fields_);
  const auto count = fields_.size() == 1 ? count_of(fields_[0]) : std::nullopt;
  if (!count)
    throw lines_.wrong(
        fmt::format("{} is no number of atoms, with which a frame begins", quoted(lines_.line())));
  lines_.advance();
  return *count;
}

void XyzReader::read_comment() {
  const auto properties = value_of(lines_.line(), "Properties");
  std::vector<std::string> names{"element", "x", "y", "z"};
  ImportOptions options = options_;
  if (properties) names = names_of(*properties, lines_.number(), options.color);
  if (!columns_ || columns_->names() != names)
    columns_.emplace(std::move(names), options, lines_.number());
  lines_.advance();
}

std::optional<Particles> XyzReader::next_frame() {
  Particles particles;
  std::size_t count = read_count();
  for (; count == 0; count = read_count()) {
    add_omission(particles.omissions, lines_.number(), "frame without atoms left out",
                 "frames without atoms left out");
    lines_.advance();  // its comment
    lines_.skip_blank();
    if (lines_.at_end()) return std::nullopt;
  }
  read_comment();
  for (std::size_t i = 0; i < count; ++i) {
    if (lines_.at_end())
      throw lines_.wrong(fmt::format("the file ends after {} of {} atoms", i, count));
    split_fields(lines_.line(), fields_);
    columns_->add(fields_, lines_.number(), particles);
    lines_.advance();
  }
  columns_->finish(particles);
  lines_.skip_blank();
  return particles;
}

}  // namespace raytracer::client

#include "client/formats/lines.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "client/formats/ascii.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

constexpr std::size_t longest_line = 1 << 20;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_white_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_white_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

Lines::Lines(TextSource& source) : source_(source), room_(new char[longest_line]) {
  advance();
  line_ = without_byte_order_mark(line_);
}

/// More bytes behind those that are unread; false at the end.
bool Lines::fill() {
  if (begin_ > 0) {
    std::memmove(room_.get(), room_.get() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == longest_line) throw LineError{number_ + 1, "the line is longer than a megabyte"};
  const std::size_t count = source_.read(std::span(room_.get(), longest_line).subspan(end_));
  end_ += count;
  return count > 0;
}

void Lines::advance() {
  const char* newline = nullptr;
  for (std::size_t searched = 0;;) {
    const char* const begin = room_.get() + begin_;
    newline =
        static_cast<const char*>(std::memchr(begin + searched, '\n', end_ - begin_ - searched));
    searched = end_ - begin_;
    if (newline || !fill()) break;
  }
  line_ = {};
  if (!newline && begin_ == end_) {
    at_end_ = true;
    number_ = std::max(number_, 1);
    return;
  }
  const std::size_t length =
      newline ? static_cast<std::size_t>(newline - room_.get()) - begin_ : end_ - begin_;
  line_ = {room_.get() + begin_, length};
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  begin_ += length + (newline ? 1 : 0);
  ++number_;
}

void Lines::skip_blank() {
  while (!at_end_ && std::all_of(line_.begin(), line_.end(), is_white_space)) advance();
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t at = 0; at < line.size();) {
    if (is_white_space(line[at])) {
      ++at;
      continue;
    }
    const std::size_t begin = at;
    while (at < line.size() && !is_white_space(line[at])) ++at;
    fields.push_back(line.substr(begin, at - begin));
  }
}

bool split_quoted(std::string_view line, char separator, std::vector<std::string_view>& fields,
                  std::vector<std::string>& unquoted) {
  fields.clear();
  unquoted.clear();
  unquoted.reserve(1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), '"')));
  for (std::size_t at = 0; at <= line.size(); ++at) {
    while (at < line.size() && line[at] != separator && is_white_space(line[at])) ++at;
    if (at == line.size() || line[at] != '"') {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      fields.push_back(trimmed(line.substr(at, end - at)));
      at = end;
      continue;
    }
    std::string& field = unquoted.emplace_back();
    for (++at;; ++at) {
      if (at >= line.size()) return false;
      if (line[at] == '"' && (at + 1 == line.size() || line[at + 1] != '"')) break;
      if (line[at] == '"') ++at;
      field += line[at];
    }
    fields.push_back(field);
    at = std::min(line.find(separator, at + 1), line.size());
  }
  return true;
}

}  // namespace raytracer::client

#include "client/formats/words.h"

namespace raytracer::client {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void Words::advance() {
  const auto is_over = [this] { return end_ >= text_.size(); };
  for (bool is_comment = false; !is_over(); ++end_) {
    const char c = text_[end_];
    if (c == '\n') ++lines_read_;
    is_comment = c != '\n' && (is_comment || c == '#');
    if (!is_comment && !is_space(c)) break;
  }
  const std::size_t begin = end_;
  while (!is_over() && !is_space(text_[end_]) && text_[end_] != '#') ++end_;
  word_ = text_.substr(begin, end_ - begin);
  if (!word_.empty()) line_ = lines_read_;
}

}  // namespace raytracer::client

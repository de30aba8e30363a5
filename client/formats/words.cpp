#include "client/formats/words.h"

#include "client/formats/ascii.h"

namespace raytracer::client {

void Words::advance() {
  const auto is_over = [this] { return end_ >= text_.size(); };
  for (bool is_comment = false; !is_over(); ++end_) {
    const char c = text_[end_];
    if (c == '\n') ++lines_read_;
    is_comment = c != '\n' && (is_comment || c == '#');
    if (!is_comment && !is_white_space(c)) break;
  }
  const std::size_t begin = end_;
  while (!is_over() && !is_white_space(text_[end_]) && text_[end_] != '#') ++end_;
  word_ = text_.substr(begin, end_ - begin);
  if (!word_.empty()) line_ = lines_read_;
}

}  // namespace raytracer::client

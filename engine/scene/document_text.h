// A document's text, and the memory behind it that a parser may look at: simdjson looks ahead, and
// what ends sooner has to be copied first, which of a large scene takes as long as to read its
// numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace raytracer {

/// UTF-8, which must outlive it. A string's capacity is memory that may be looked at.
class DocumentText {
 public:
  /// With so much behind it a text is not copied.
  static constexpr std::size_t read_ahead = 64;

  // Implicit, so that whoever has a text need not know.
  DocumentText(std::string_view text) : text_(text), readable_bytes_(text.size()) {}
  DocumentText(const char* text) : DocumentText(std::string_view(text)) {}
  DocumentText(const std::string& text) : text_(text), readable_bytes_(text.capacity()) {}

  std::string_view view() const { return text_; }
  bool has_room_behind() const { return readable_bytes_ - text_.size() >= read_ahead; }

 private:
  std::string_view text_;
  std::size_t readable_bytes_;
};

}  // namespace raytracer

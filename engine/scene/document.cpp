#include "engine/scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <vector>

#include "engine/memory/page_allocator.h"
#include "engine/scene/large_numbers.h"
#include "engine/scene/limits.h"
#include "engine/scene/path.h"
#include "engine/scene/syntax_error.h"

namespace raytracer {
namespace {

using simdjson::dom::element_type;

simdjson::error_code parse(const DocumentText& whole_text, simdjson::dom::document& document) {
  static_assert(DocumentText::read_ahead >= simdjson::SIMDJSON_PADDING);
  std::string_view text = whole_text.view();
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  LargeArray<char> copy;
  if (!whole_text.has_room_behind()) {
    copy.resize(text.size() + DocumentText::read_ahead);
    std::copy(text.begin(), text.end(), copy.begin());
    text = {copy.data(), text.size()};
  }
  simdjson::dom::parser parser;
  simdjson::error_code error = parser.allocate(text.size());
  if (!error) error = document.allocate(text.size());
  if (!error) {
    // What simdjson writes most: in small pages it takes a third longer.
    const HugePages tape(document.tape.get(), text.size() * sizeof document.tape[0]);
    auto& indexes = parser.implementation->structural_indexes;
    const HugePages places(indexes.get(), text.size() * sizeof indexes[0]);
    error = parser.parse_into_document(document, text.data(), text.size(), false).error();
  }
  if (error == simdjson::MEMALLOC) throw std::bad_alloc();
  return error;
}

/// Looks at all values, also at those that no reader knows, for what is JSON and wrong all the
/// same.
class Inspection {
 public:
  /// Of a text spelled anew for the sake of `numbers`, if there are any.
  Inspection(std::string_view text, const std::vector<LargeNumber>& numbers, ErrorList& errors)
      : text_(text), numbers_(numbers), errors_(errors) {}

  /// Throws an Error if it is nested too deep.
  // NOLINTNEXTLINE(misc-no-recursion): no deeper than deepest_nesting
  void visit(const JsonValue& value, const Path& path, int depth = 0) {
    const auto type = value.type();
    if (type == element_type::UINT64)
      visit_unsigned(value.get_uint64().value_unsafe() - first_unsigned, path);
    if (type != element_type::ARRAY && type != element_type::OBJECT) return;
    if (depth == deepest_nesting) throw nested_too_deep(path.pointer());
    if (type == element_type::ARRAY)
      visit_elements(value.get_array().value_unsafe(), path, depth + 1);
    else
      visit_members(value.get_object().value_unsafe(), path, depth + 1);
  }

  /// Whether there are integers that have to be spelled anew.
  bool found_large_integer() const { return found_large_integer_; }

 private:
  static bool is_plain_number(element_type type) {
    return type == element_type::DOUBLE || type == element_type::INT64;
  }

  /// Whether it is a number, or an array of numbers, in which nothing can be wrong: of these large
  /// scenes have millions.
  static bool is_plain(const JsonValue& value, int depth) {
    const element_type type = value.type();
    if (type != element_type::ARRAY || depth == deepest_nesting) return is_plain_number(type);
    const JsonArray array = value.get_array().value_unsafe();
    return std::all_of(array.begin(), array.end(),
                       [](const JsonValue& element) { return is_plain_number(element.type()); });
  }

  void visit_elements(const JsonArray& array, const Path& path, int depth) {
    std::size_t index = 0;
    for (const JsonValue element : array) {
      if (!is_plain(element, depth)) visit(element, path.child(index), depth);
      ++index;
    }
  }

  void visit_members(const JsonObject& object, const Path& path, int depth) {
    keys_.clear();
    for (const auto& member : object) keys_.push_back(member.key);
    std::sort(keys_.begin(), keys_.end(), [](std::string_view a, std::string_view b) {
      return a.size() != b.size() ? a.size() < b.size() : a < b;  // most differ in size
    });
    for (std::size_t i = 1; i < keys_.size(); ++i)
      if (keys_[i] == keys_[i - 1])
        errors_.add_about_key(path.child(keys_[i]), [&] {
          return fmt::format("\"{}\" stands twice in the same object; keep one", keys_[i]);
        });
    for (const auto& member : object) visit(member.value, path.child(member.key), depth);
  }

  void visit_unsigned(std::size_t place, const Path& path) {
    if (numbers_.empty()) {
      found_large_integer_ = true;
      return;
    }
    const LargeNumber& number = numbers_.at(place);
    constexpr std::size_t shown = 40;
    errors_.add(ErrorKind::invalid, path, [&] {
      return fmt::format("{}{} is beyond the largest double (about 1.8e308)",
                         text_.substr(number.begin, std::min(number.size, shown)),
                         number.size > shown ? "..." : "");
    });
  }

  std::string_view text_;
  const std::vector<LargeNumber>& numbers_;
  ErrorList& errors_;
  std::vector<std::string_view> keys_;  ///< of the object that is looked at
  bool found_large_integer_ = false;
};

}  // namespace

Result<Document> parse_document(const DocumentText& whole_text) try {
  const std::string_view text = whole_text.view();
  Document document;
  std::vector<LargeNumber> numbers;
  if (!parse(whole_text, document.json)) {
    Inspection inspection(text, numbers, document.errors);
    inspection.visit(document.root(), Path());
    if (!inspection.found_large_integer()) return document;
  }
  numbers = find_large_numbers(text);
  if (const std::optional<Error> error = find_syntax_error(with_zeros(text, numbers)))
    return std::vector{*error};
  if (const auto error = parse(spelled_anew(text, numbers), document.json))
    return std::vector{
        Error{ErrorKind::syntax, "", fmt::format("not JSON: {}", simdjson::error_message(error))}};
  document.errors = {};
  Inspection(text, numbers, document.errors).visit(document.root(), Path());
  return document;
} catch (const Error& too_deep) {
  return std::vector{too_deep};
}

}  // namespace raytracer

#include "engine/scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>

#include "engine/scene/limits.h"
#include "engine/scene/path.h"

namespace raytracer {
namespace {

using nlohmann::json;

/// A number that no double holds: where it stands in the text, and the how manieth number it is.
struct HugeNumber {
  std::size_t begin;
  std::size_t size;
  std::size_t ordinal;
};

/// Line and column, both from 1 and in characters, of a byte in a text.
std::string describe_position(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column =
      1 + std::count_if(in_line.begin(), in_line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;  // UTF-8's first bytes
      });
  return fmt::format("line {}, column {}", line, column);
}

/// nlohmann's words behind "syntax error", without its own position and numbers.
std::string describe_syntax_error(const json::exception& exception) {
  const std::string_view what = exception.what();
  const auto start = what.find("syntax error ");
  return std::string(start == std::string_view::npos ? what : what.substr(start));
}

/// Receives the parser's events and lays the nodes down in their order.
class DocumentBuilder : public nlohmann::json_sax<json> {
 public:
  /// `huge_ordinals`: the numbers that were replaced in `text`, in increasing order.
  DocumentBuilder(std::string_view text, const std::vector<std::size_t>& huge_ordinals,
                  Document& document)
      : text_(text), huge_ordinals_(huge_ordinals), document_(document) {}

  bool null() override { return leaf(JsonKind::null); }
  bool boolean(bool) override { return leaf(JsonKind::boolean); }
  bool number_integer(std::int64_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) override { return number(value); }
  bool string(std::string& value) override {
    before_value();
    append_string(value);
    return true;
  }
  bool binary(json::binary_t&) override { return false; }  // JSON text has none

  bool start_object(std::size_t) override { return open(JsonKind::object); }
  bool start_array(std::size_t) override { return open(JsonKind::array); }
  bool end_array() override { return close(); }
  bool end_object() override {
    report_duplicates();
    return close();
  }

  bool key(std::string& name) override {
    append_string(name);
    open_.back().key = static_cast<std::uint32_t>(document_.nodes.size() - 1);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& last_token,
                   const json::exception& exception) override {
    if (exception.id == number_out_of_range && position >= last_token.size() &&
        text_.substr(position - last_token.size(), last_token.size()) == last_token) {
      huge_number_ = HugeNumber{position - last_token.size(), last_token.size(), number_count_};
      before_value();
      failure_ = {ErrorKind::invalid, pointer(),
                  fmt::format("{} is beyond the largest double (about 1.8e308)", last_token)};
    } else {
      failure_ = {ErrorKind::syntax, "",
                  fmt::format("not JSON: {}: {}", describe_position(text_, position - 1),
                              describe_syntax_error(exception))};
    }
    return false;
  }

  const Error& failure() const { return failure_; }
  std::optional<HugeNumber> huge_number() const { return huge_number_; }

 private:
  static constexpr int number_out_of_range = 406;  // nlohmann's number for it

  /// An array or object that has begun and not ended.
  struct Open {
    std::uint32_t node;
    std::uint32_t key = 0;    ///< the node of the latest key, in an object
    std::size_t element = 0;  ///< how many values have begun, in an array
  };

  void before_value() {
    if (!open_.empty()) ++open_.back().element;
  }

  void append_node(JsonKind kind) {
    Document::Node node;
    node.kind = kind;
    node.end = static_cast<std::uint32_t>(document_.nodes.size() + 1);
    document_.nodes.push_back(node);
  }

  void append_string(const std::string& value) {
    append_node(JsonKind::string);
    document_.nodes.back().string = {static_cast<std::uint32_t>(document_.text.size()),
                                     static_cast<std::uint32_t>(value.size())};
    document_.text += value;
  }

  bool leaf(JsonKind kind) {
    before_value();
    append_node(kind);
    return true;
  }

  bool number(double value) {
    leaf(JsonKind::number);
    const bool is_huge =
        std::binary_search(huge_ordinals_.begin(), huge_ordinals_.end(), number_count_++);
    document_.nodes.back().number = is_huge ? std::numeric_limits<double>::quiet_NaN() : value;
    return true;
  }

  bool open(JsonKind kind) {
    before_value();
    if (static_cast<std::int64_t>(open_.size()) == deepest_nesting) {
      failure_ = {ErrorKind::invalid, pointer(),
                  fmt::format("nested deeper than {} levels; a scene needs no more than 6",
                              deepest_nesting)};
      return false;
    }
    append_node(kind);
    open_.push_back({static_cast<std::uint32_t>(document_.nodes.size() - 1)});
    return true;
  }

  bool close() {
    document_.nodes[open_.back().node].end = static_cast<std::uint32_t>(document_.nodes.size());
    open_.pop_back();
    return true;
  }

  std::string_view string_of(std::uint32_t node) const {
    return JsonValue(document_, node).string();
  }

  /// The pointer of the value that has just begun.
  std::string pointer() const {
    std::vector<Path> steps(1);
    steps.reserve(open_.size() + 1);  // parents are pointed to
    for (const Open& container : open_) {
      const bool is_array = document_.nodes[container.node].kind == JsonKind::array;
      steps.push_back(is_array ? steps.back().child(container.element - 1)
                               : steps.back().child(string_of(container.key)));
    }
    return steps.back().pointer();
  }

  void report_duplicates() {
    const std::uint32_t first = open_.back().node + 1;
    const auto size = static_cast<std::uint32_t>(document_.nodes.size());
    // A set costs an allocation a key: most objects have few keys, and there are many of them.
    constexpr std::uint32_t few = 16;
    std::unordered_set<std::string_view> seen;
    std::uint32_t count = 0;
    for (std::uint32_t i = first; i < size; i = document_.nodes[i + 1].end, ++count) {
      bool repeated = false;
      if (count < few) {
        for (std::uint32_t j = first; j < i && !repeated; j = document_.nodes[j + 1].end)
          repeated = string_of(j) == string_of(i);
      } else {
        if (seen.empty())
          for (std::uint32_t j = first; j < i; j = document_.nodes[j + 1].end)
            seen.insert(string_of(j));
        repeated = !seen.insert(string_of(i)).second;
      }
      if (!repeated) continue;
      open_.back().key = i;
      document_.errors.push_back(
          {ErrorKind::invalid, pointer(),
           fmt::format("\"{}\" stands twice in the same object; keep one", string_of(i))});
    }
  }

  std::string_view text_;
  const std::vector<std::size_t>& huge_ordinals_;
  Document& document_;
  std::size_t number_count_ = 0;
  std::vector<Open> open_;
  Error failure_;
  std::optional<HugeNumber> huge_number_;
};

}  // namespace

Result<Document> parse_document(std::string_view text) {
  // The parser gives up at a number that no double holds. To find the document's other errors all
  // the same, such a number is noted, replaced by a 0 and the text read again, a few times.
  constexpr int most_huge_numbers = 16;
  std::vector<Error> huge_number_errors;
  std::vector<std::size_t> huge_ordinals;
  std::string patched;
  for (;;) {
    Document document;
    document.nodes.reserve(text.size() / 8);
    DocumentBuilder builder(text, huge_ordinals, document);
    if (json::sax_parse(text, &builder)) {
      document.errors.insert(document.errors.end(), huge_number_errors.begin(),
                             huge_number_errors.end());
      return document;
    }
    if (!builder.huge_number()) return std::vector{builder.failure()};
    huge_number_errors.push_back(builder.failure());
    if (huge_number_errors.size() == most_huge_numbers) return huge_number_errors;
    huge_ordinals.push_back(builder.huge_number()->ordinal);
    if (patched.empty()) patched = text;
    patched.replace(builder.huge_number()->begin, builder.huge_number()->size,
                    std::string(builder.huge_number()->size - 1, ' ') + '0');
    text = patched;
  }
}

}  // namespace raytracer

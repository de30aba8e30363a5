#include "engine/scene/thorough_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/scene/limits.h"
#include "engine/scene/path.h"
#include "engine/scene/repeated_keys.h"

namespace raytracer {
namespace {

using nlohmann::json;

/// A number that no double holds: where it stands in the text, and the how manieth number it is.
struct HugeNumber {
  std::size_t ordinal;
  std::size_t begin;
  std::size_t size;
};

/// Every number of the text that no double holds, in order. Expects JSON; finds something
/// harmless in other text.
std::vector<HugeNumber> find_huge_numbers(std::string_view text) {
  constexpr std::string_view number_characters = "+-.0123456789eE";
  std::vector<HugeNumber> found;
  std::size_t ordinal = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
    } else if (text[i] == '-' || (text[i] >= '0' && text[i] <= '9')) {
      const std::size_t end = std::min(text.find_first_not_of(number_characters, i), text.size());
      const std::string token(text.substr(i, end - i));
      if (std::isinf(std::strtod(token.c_str(), nullptr))) found.push_back({ordinal, i, end - i});
      ++ordinal;
      i = end - 1;
    }
  }
  return found;
}

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
  /// `huge_numbers`: those that a 0 stands for in the text that is parsed.
  DocumentBuilder(std::string_view text, const std::vector<HugeNumber>& huge_numbers,
                  Document& document)
      : text_(text), huge_numbers_(huge_numbers), document_(document) {}

  bool null() override { return leaf(JsonKind::null); }
  bool boolean(bool value) override {
    leaf(JsonKind::boolean);
    document_.nodes.back().number = value ? 1 : 0;
    return true;
  }
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

  bool parse_error(std::size_t position, const std::string&,
                   const json::exception& exception) override {
    has_huge_number_ = exception.id == number_out_of_range;
    failure_ = {ErrorKind::syntax, "",
                fmt::format("not JSON: {}: {}", describe_position(text_, position - 1),
                            describe_syntax_error(exception))};
    return false;
  }

  const Error& failure() const { return failure_; }
  /// Whether the parser gave up at a number that no double holds.
  bool has_huge_number() const { return has_huge_number_; }

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
    if (next_huge_ < huge_numbers_.size() && huge_numbers_[next_huge_].ordinal == number_count_) {
      const HugeNumber& huge = huge_numbers_[next_huge_++];
      constexpr std::size_t shown = 40;
      complain(fmt::format("{}{} is beyond the largest double (about 1.8e308)",
                           text_.substr(huge.begin, std::min(huge.size, shown)),
                           huge.size > shown ? "..." : ""));
      value = std::numeric_limits<double>::quiet_NaN();
    }
    ++number_count_;
    document_.nodes.back().number = value;
    return true;
  }

  bool open(JsonKind kind) {
    before_value();
    if (static_cast<std::int64_t>(open_.size()) == deepest_nesting) {
      with_path([&](const Path& path) {
        failure_ = {ErrorKind::invalid, path.pointer(),
                    fmt::format("nested deeper than {} levels; a scene needs no more than 6",
                                deepest_nesting)};
      });
      return false;
    }
    append_node(kind);
    document_.nodes.back().numbers = {};
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

  /// Calls use(path) with the place of the value that has just begun.
  template <typename Use>
  void with_path(Use use) const {
    std::vector<Path> steps(1);
    steps.reserve(open_.size() + 1);  // parents are pointed to
    for (const Open& container : open_) {
      const bool is_array = document_.nodes[container.node].kind == JsonKind::array;
      steps.push_back(is_array ? steps.back().child(container.element - 1)
                               : steps.back().child(string_of(container.key)));
    }
    use(steps.back());
  }

  void complain(std::string detail) {
    with_path([&](const Path& path) {
      document_.errors.add(ErrorKind::invalid, path, std::move(detail));
    });
  }

  void report_duplicates() {
    for_each_repeated_key(document_, open_.back().node + 1, [&](std::uint32_t key) {
      if (document_.errors.is_full()) {
        document_.errors.add_unlisted();
        return;
      }
      open_.back().key = key;
      complain(fmt::format("\"{}\" stands twice in the same object; keep one", string_of(key)));
    });
  }

  std::string_view text_;
  const std::vector<HugeNumber>& huge_numbers_;
  std::size_t next_huge_ = 0;
  Document& document_;
  std::size_t number_count_ = 0;
  std::vector<Open> open_;
  Error failure_;
  bool has_huge_number_ = false;
};

}  // namespace

Result<Document> parse_thoroughly(std::string_view text) {
  // The parser gives up at a number that no double holds. To find the document's other errors all
  // the same, all such numbers are then replaced by zeros, and noted as the zeros are read.
  std::vector<HugeNumber> huge_numbers;
  std::string patched;
  for (;;) {
    Document document;
    document.nodes.reserve(text.size() / 8);
    DocumentBuilder builder(text, huge_numbers, document);
    if (json::sax_parse(huge_numbers.empty() ? text : patched, &builder)) {
      // The parser takes a zero byte for the text's end.
      const std::size_t zero = text.find('\0');
      if (zero == std::string_view::npos) return document;
      return std::vector{
          Error{ErrorKind::syntax, "",
                fmt::format("not JSON: {}: a zero byte", describe_position(text, zero))}};
    }
    if (!builder.has_huge_number() || !huge_numbers.empty()) return std::vector{builder.failure()};
    huge_numbers = find_huge_numbers(text);
    patched = text;
    for (const HugeNumber& huge : huge_numbers)
      patched.replace(huge.begin, huge.size, std::string(huge.size - 1, ' ') + '0');
  }
}

}  // namespace raytracer

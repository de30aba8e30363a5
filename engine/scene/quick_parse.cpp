#include "engine/scene/quick_parse.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/scene/limits.h"
#include "engine/scene/repeated_keys.h"

namespace raytracer {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The bytes that stand for themselves inside a string.
constexpr std::array<bool, 256> plain_characters = [] {
  std::array<bool, 256> plain{};
  for (std::size_t c = 0x20; c < 0x80; ++c) plain[c] = c != '"' && c != '\\';
  return plain;
}();

bool is_plain(char c) { return plain_characters[static_cast<unsigned char>(c)]; }

/// The powers of ten that are doubles.
constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The double nearest to a well-formed number; nothing if it is beyond them all.
std::optional<double> nearest_double(const char* begin, const char* end) {
  double value = 0;
#ifdef __cpp_lib_to_chars
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ec != std::errc{} || result.ptr != end) return {};
#else  // libc++ before LLVM 20 has it for integers only
  value = std::strtod(std::string(begin, end).c_str(), nullptr);
#endif
  if (!std::isfinite(value)) return {};
  return value;
}

class QuickParser {
 public:
  QuickParser(std::string_view text, Document& document)
      : begin_(text.data()), at_(begin_), end_(begin_ + text.size()), document_(document) {
    if (text.starts_with("\xef\xbb\xbf")) at_ += 3;  // the byte order mark
  }

  /// Whether all of the text is a document.
  bool parse() {
    skip_space();
    if (!parse_value(0)) return false;
    skip_space();
    return at_ == end_;
  }

 private:
  bool is_at(char c) const { return at_ < end_ && *at_ == c; }
  bool is_at_number() const { return at_ < end_ && (*at_ == '-' || is_digit(*at_)); }

  bool take(char c) {
    if (!is_at(c)) return false;
    ++at_;
    return true;
  }

  void skip_space() {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\t' || *at_ == '\r')) ++at_;
  }

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(document_.nodes.size()); }

  Document::Node& append_node(JsonKind kind) {
    Document::Node node;
    node.kind = kind;
    node.end = node_count() + 1;
    document_.nodes.push_back(node);
    return document_.nodes.back();
  }

  bool parse_value(std::int64_t depth) {
    if (at_ == end_) return false;
    switch (*at_) {
      case '{':
        return depth < deepest_nesting && parse_object(depth);
      case '[':
        return depth < deepest_nesting && parse_array(depth);
      case '"':
        return parse_string();
      case 't':
        return parse_word("true", JsonKind::boolean);
      case 'f':
        return parse_word("false", JsonKind::boolean);
      case 'n':
        return parse_word("null", JsonKind::null);
      default:
        return parse_number_node();
    }
  }

  bool parse_object(std::int64_t depth) {
    const std::uint32_t object = node_count();
    append_node(JsonKind::object);
    ++at_;
    skip_space();
    if (!is_at('}')) {
      do {
        skip_space();
        if (!is_at('"') || !parse_string()) return false;
        skip_space();
        if (!take(':')) return false;
        skip_space();
        if (!parse_value(depth + 1)) return false;
        skip_space();
      } while (take(','));
    }
    document_.nodes[object].end = node_count();
    bool has_duplicates = false;
    for_each_repeated_key(document_, object + 1, [&](std::uint32_t) { has_duplicates = true; });
    return take('}') && !has_duplicates;
  }

  bool parse_array(std::int64_t depth) {
    const std::uint32_t array = node_count();
    const auto first_number = static_cast<std::uint32_t>(document_.numbers.size());
    append_node(JsonKind::array);
    bool has_only_numbers = true;
    ++at_;
    skip_space();
    if (!is_at(']')) {
      do {
        skip_space();
        if (has_only_numbers && !is_at_number()) {
          has_only_numbers = false;
          give_nodes_to_numbers(first_number);
        }
        if (!(has_only_numbers ? parse_number() : parse_value(depth + 1))) return false;
        skip_space();
      } while (take(','));
    }
    Document::Node& node = document_.nodes[array];
    node.end = node_count();
    // Numbers behind the first one are those of arrays inside this one, unless it has only numbers.
    const auto last_number = static_cast<std::uint32_t>(document_.numbers.size());
    node.numbers = {first_number, has_only_numbers ? last_number - first_number : 0};
    return take(']');
  }

  /// For the numbers of an array in which something else follows.
  void give_nodes_to_numbers(std::uint32_t first_number) {
    for (std::size_t i = first_number; i < document_.numbers.size(); ++i)
      append_node(JsonKind::number).number = document_.numbers[i];
    document_.numbers.resize(first_number);
  }

  bool parse_word(std::string_view word, JsonKind kind) {
    const auto rest = static_cast<std::size_t>(end_ - at_);
    if (!std::string_view(at_, rest).starts_with(word)) return false;
    at_ += word.size();
    append_node(kind);
    document_.nodes.back().number = word == "true" ? 1 : 0;
    return true;
  }

  bool parse_string() {
    const char* const content = at_ + 1;
    const char* end = content;
    while (end < end_ && is_plain(*end)) ++end;
    if (end == end_) return false;
    if (*end != '"') return parse_unusual_string();
    append_node(JsonKind::string).string = {static_cast<std::uint32_t>(content - begin_),
                                            static_cast<std::uint32_t>(end - content)};
    at_ = end + 1;
    return true;
  }

  /// A string with escapes, or with characters beyond ASCII.
  bool parse_unusual_string() {
    const char* end = at_ + 1;
    while (end < end_ && *end != '"') end += *end == '\\' ? 2 : 1;
    if (end >= end_) return false;
    const auto json = nlohmann::json::parse(at_, end + 1, nullptr, /*allow_exceptions=*/false);
    if (!json.is_string()) return false;
    const auto& string = json.get_ref<const std::string&>();
    append_node(JsonKind::string).string = {
        static_cast<std::uint32_t>(document_.source.size() + document_.text.size()),
        static_cast<std::uint32_t>(string.size())};
    document_.text += string;
    at_ = end + 1;
    return true;
  }

  bool parse_number_node() {
    const std::optional<double> number = parse_double();
    if (!number) return false;
    append_node(JsonKind::number).number = *number;
    return true;
  }

  bool parse_number() {
    const std::optional<double> number = parse_double();
    if (number) document_.numbers.push_back(*number);
    return number.has_value();
  }

  /// Goes on behind the digits, and adds them to the right of `value`, modulo 2^64. Returns how
  /// many there were.
  std::int64_t take_digits(std::uint64_t& value) {
    const char* const first = at_;
    for (; at_ < end_ && is_digit(*at_); ++at_)
      value = 10 * value + static_cast<std::uint64_t>(*at_ - '0');
    return at_ - first;
  }

  std::optional<double> parse_double() {
    constexpr std::int64_t digits_in_64_bits = 19;
    constexpr std::uint64_t largest_exact = 1ULL << 53;
    const char* const number = at_;
    const bool is_negative = take('-');
    const bool starts_with_zero = is_at('0');
    std::uint64_t digits = 0;
    std::int64_t count = take_digits(digits);
    if (count == 0 || (starts_with_zero && count > 1)) return {};
    bool is_integer = true;
    std::int64_t exponent = 0;
    if (take('.')) {
      is_integer = false;
      exponent = -take_digits(digits);
      if (exponent == 0) return {};
      count -= exponent;
    }
    if (is_at('e') || is_at('E')) {
      is_integer = false;
      ++at_;
      const bool is_small = is_at('-');
      if (is_small || is_at('+')) ++at_;
      std::uint64_t written = 0;
      const std::int64_t written_count = take_digits(written);
      if (written_count == 0) return {};
      if (written_count > 4) return nearest_double(number, at_);
      exponent +=
          is_small ? -static_cast<std::int64_t>(written) : static_cast<std::int64_t>(written);
    }
    if (count > digits_in_64_bits) return nearest_double(number, at_);

    auto value = static_cast<double>(digits);  // the nearest, as is the result of one operation
    if (is_integer) return is_negative && digits != 0 ? -value : value;  // an integer -0 is 0
    if (digits > largest_exact || std::abs(exponent) >= std::ssize(powers_of_ten))
      return nearest_double(number, at_);
    if (exponent < 0)
      value /= powers_of_ten[static_cast<std::size_t>(-exponent)];
    else
      value *= powers_of_ten[static_cast<std::size_t>(exponent)];
    return is_negative ? -value : value;
  }

  const char* const begin_;
  const char* at_;
  const char* const end_;
  Document& document_;
};

}  // namespace

std::optional<Document> parse_quickly(std::string_view text) {
  Document document;
  document.source = text;
  // Memory that is not written costs nothing; of what most documents need this is the most.
  document.nodes.reserve(text.size() / 8);
  document.numbers.reserve(text.size() / 8);
  if (!QuickParser(text, document).parse()) return {};
  return document;
}

}  // namespace raytracer

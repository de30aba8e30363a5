// What is read of a document against nlohmann's parser: the same texts are JSON to both, and mean
// the same values, to the bit.

#include "engine/scene/document.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <vector>

#include "engine/scene/limits.h"
#include "tests/scene/full_document.h"

namespace raytracer::test {
namespace {

bool are_equal(const JsonValue& value, const json& expected) {
  if (expected.is_array()) {
    const JsonArray array = value;
    return std::equal(array.begin(), array.end(), expected.begin(), expected.end(), are_equal);
  }
  if (expected.is_object()) {
    const JsonObject object = value;
    std::size_t count = 0;
    for (const auto& [key, member] : object) {
      const auto found = expected.find(key);
      if (found == expected.end() || !are_equal(member, *found)) return false;
      ++count;
    }
    return count == expected.size();
  }
  if (expected.is_string()) return expected == std::string_view(value);
  if (expected.is_boolean()) return expected == bool(value);
  if (expected.is_null()) return value.is_null();
  return std::bit_cast<std::uint64_t>(double(value)) ==
         std::bit_cast<std::uint64_t>(expected.get<double>());
}

int depth_of(const json& value) {
  int depth = 0;
  if (value.is_structured())
    for (const json& part : value) depth = std::max(depth, depth_of(part));
  return depth + (value.is_structured() ? 1 : 0);
}

/// Whether the text is read without errors; a failure if nlohmann's parser disagrees.
bool is_accepted(const std::string& text) {
  // Not a byte behind it belongs to the text: a sanitizer would see it read.
  const auto exact = std::make_unique<char[]>(text.size());
  std::copy(text.begin(), text.end(), exact.get());
  const Result<Document> read = parse_document(std::string_view(exact.get(), text.size()));
  const json expected = json::parse(text, nullptr, /*allow_exceptions=*/false);
  const bool has_zero_byte = text.find('\0') != std::string::npos;  // to nlohmann its end
  if (!read.ok()) {
    const Error& error = read.errors().at(0);
    EXPECT_EQ(read.errors().size(), 1U);
    if (error.kind == ErrorKind::syntax)
      EXPECT_TRUE(expected.is_discarded() || has_zero_byte) << text.substr(0, 1000);
    else
      EXPECT_TRUE(expected.is_discarded() || depth_of(expected) > deepest_nesting);
    return false;
  }
  if (!read.value().errors.empty()) return false;  // duplicate keys, or numbers too large
  EXPECT_FALSE(expected.is_discarded()) << text.substr(0, 1000);
  EXPECT_TRUE(are_equal(read.value().root(), expected)) << text.substr(0, 1000);
  return true;
}

/// Valid documents of all sorts.
std::vector<std::string> documents() {
  std::vector<std::string> texts{
      full_document().dump(),
      full_document().dump(2),
      "\xef\xbb\xbf" + full_document().dump(),
      "\xef\xbb\xbf {}",
      "[]",
      "{}",
      " \t\r\n[ ] \n",
      "0",
      "\"\"",
      "null",
      R"([true, false, null, "a", {}, [], [[]], 1, [1], [1, 2.5, -3e2], [1, "a"], [1, [2], 3]])",
      R"([1, 2, 3, null, 4, [5, 6], 7, {"a": [8, 9], "b": 10}])",
      R"({"": {"": {"": []}}, "a": "", "A": 0, "aa": [0]})",
      R"({"a/b~": "\u0000\ud83d\ude00\"\\\/\b\f\n\r\t", "\u0061": 1, "b": "\u00e4"})",
      "{\"\xc3\xa4\": \"\xf0\x9f\x98\x80 \x7f\", \"plain\": \"plain\", \"\\\"\": \"\\\\\"}",
      std::string(64, '[') + std::string(64, ']')};
  for (const auto& entry : std::filesystem::directory_iterator(RAYTRACER_SCENES_DIR)) {
    std::ifstream file(entry.path());
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  std::string many_keys = "{\"0\": 0";
  for (int i = 1; i < 100; ++i) many_keys += ", \"" + std::to_string(i) + "\": {}";
  texts.push_back(many_keys + "}");
  return texts;
}

TEST(Document, is_read_whatever_it_says) {
  ASSERT_GT(documents().size(), 20U) << "where are the scenes?";
  for (const std::string& text : documents()) EXPECT_TRUE(is_accepted(text)) << text;
}

TEST(Document, is_what_its_text_says_with_room_behind_it_or_without) {
  for (std::string text : documents()) {
    const json expected = json::parse(text);
    for (const std::string_view behind : {"", "]", "0", "\"", "}}}"}) {
      // What is behind it is in its memory, and no part of it.
      const std::size_t size = text.size();
      text.append(behind).append(DocumentText::read_ahead, ' ').resize(size);
      ASSERT_TRUE(DocumentText(text).has_room_behind());
      for (const DocumentText& given : {DocumentText(text), DocumentText(std::string_view(text))}) {
        const Result<Document> read = parse_document(given);
        ASSERT_TRUE(read.ok()) << text;
        EXPECT_TRUE(are_equal(read.value().root(), expected)) << text;
      }
    }
  }
}

TEST(Document, of_other_texts_is_none) {
  for (const std::string text : {R"({"a": 1, "a": 1})",
                                 R"({"a": 1, "\u0061": 1})",
                                 R"({"x": [{"b": 1, "c": [], "b": 2}]})",
                                 "1e400",
                                 "[1, -1e400]",
                                 R"({"a": {"b": 1e309}})",
                                 "{\"a\": 1,}",
                                 "[1,]",
                                 "[1 2]",
                                 "{1: 2}",
                                 "{\"a\" 1}",
                                 "[1}",
                                 "{\"a\": 1]",
                                 "[",
                                 "{",
                                 "\"",
                                 "\"\\",
                                 "tru",
                                 "nul",
                                 "True",
                                 "NaN",
                                 "01",
                                 "-",
                                 "-01",
                                 "+1",
                                 ".5",
                                 "5.",
                                 "1e",
                                 "1e+",
                                 "1.e5",
                                 "0x1",
                                 "--1",
                                 "1-",
                                 "[] []",
                                 "[]x",
                                 "\"\n\"",
                                 "\"\t\"",
                                 "\"\\x\"",
                                 "\"\\u12\"",
                                 "\"\\ud800\"",
                                 "\"\\udc00\"",
                                 "\"\xff\"",
                                 "\"\xc3\"",
                                 "\"\xed\xa0\x80\"",
                                 "\"\xc0\x80\"",
                                 "\"\xf4\x90\x80\x80\"",
                                 "",
                                 " ",
                                 "\xef\xbb\xbf",
                                 "\xef\xbb",
                                 "[1, // no\n 2]"})
    EXPECT_FALSE(is_accepted(text)) << text;
  EXPECT_FALSE(is_accepted(std::string("[]\0x", 4)));
  EXPECT_FALSE(is_accepted(std::string("\"a\0b\"", 5)));
  EXPECT_FALSE(is_accepted(std::string(65, '[') + std::string(65, ']')));
  std::string many_keys = "{\"50\": 0";
  for (int i = 0; i < 100; ++i) many_keys += ", \"" + std::to_string(i) + "\": 0";
  EXPECT_FALSE(is_accepted(many_keys + "}"));
}

TEST(Document, has_numbers_to_the_last_bit) {
  std::vector<std::string> numbers{"0",
                                   "-0",
                                   "0.0",
                                   "-0.0",
                                   "0e5",
                                   "-0e-5",
                                   "0.1",
                                   "1e22",
                                   "1e23",
                                   "-1e-22",
                                   "123456789012345678",
                                   "9007199254740993",
                                   "-9007199254740993",
                                   "9007199254740993.0",
                                   "18446744073709551615",
                                   "18446744073709551616",
                                   "-9223372036854775808",
                                   "-9223372036854775809",
                                   "1e308",
                                   "1.7976931348623157e308",
                                   "2.2250738585072014e-308",
                                   "5e-324",
                                   "3e-324",
                                   "1E5",
                                   "1e+5",
                                   "0.30000000000000004",
                                   "1e0000000005",
                                   "1e-0000000005",
                                   "100000000000000000000000e-23",
                                   "0.000000000000000000000001e24",
                                   "2.2250738585072011e-308",
                                   "1" + std::string(300, '0'),
                                   "0." + std::string(300, '0') + "1",
                                   std::string(50, '9')};
  for (const std::string& number : numbers) EXPECT_TRUE(is_accepted(number)) << number;
  std::mt19937_64 generator(1);
  const auto below = [&](std::uint64_t limit) { return generator() % limit; };
  for (int i = 0; i < 200'000; ++i) {
    std::string number = below(2) == 0 ? "" : "-";
    number += std::to_string(below(2) == 0 ? below(1000) : generator() >> below(64));
    if (below(2) == 0) number += '.' + std::to_string(generator() >> below(64));
    if (below(3) == 0) number += 'e' + std::to_string(static_cast<int>(below(80)) - 40);
    ASSERT_TRUE(is_accepted(number)) << number;
    ASSERT_TRUE(is_accepted("[1," + number + "]")) << number;
  }
}

TEST(Document, is_read_after_mutations_if_it_is_still_one) {
  static constexpr std::array<const char*, 40> pieces{"",
                                                      "\"",
                                                      "\\",
                                                      "{",
                                                      "}",
                                                      "[",
                                                      "]",
                                                      ",",
                                                      ":",
                                                      "0",
                                                      "1",
                                                      "-",
                                                      "+",
                                                      ".",
                                                      "e",
                                                      "E",
                                                      "1e400",
                                                      "1e-400",
                                                      "true",
                                                      "false",
                                                      "null",
                                                      " ",
                                                      "\n",
                                                      "\t",
                                                      "\0",
                                                      "[1,",
                                                      "]]",
                                                      "{\"a\":",
                                                      "\"a\"",
                                                      "\\u0041",
                                                      "\\ud800",
                                                      "\\n",
                                                      "\xc3\xa4",
                                                      "\xff",
                                                      "\xed\xa0\x80",
                                                      "\xef\xbb\xbf",
                                                      "\"type\":",
                                                      "1.5",
                                                      "-0",
                                                      "9999999999999999999999"};
  std::mt19937_64 generator(1);
  const auto below = [&](std::size_t limit) { return generator() % limit; };
  const std::vector<std::string> originals = documents();
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 60'000; ++i) {
    std::string text = originals[below(originals.size())];
    if (text.size() > 5000) text = originals[below(3)];
    for (std::size_t k = below(3) + 1; k > 0; --k) {
      const std::size_t at = below(text.size() + 1);
      switch (below(4)) {
        case 0:
          text.insert(at, pieces[below(pieces.size())]);
          break;
        case 1:
          text.replace(at, below(4), pieces[below(pieces.size())]);
          break;
        case 2:
          text.erase(at, below(10));
          break;
        default:
          text.insert(below(text.size() + 1), text.substr(at, below(40)));
      }
    }
    (is_accepted(text) ? accepted : refused) += 1;
    if (HasFailure()) return;
  }
  EXPECT_GT(accepted, 6000);
  EXPECT_GT(refused, 6000);
}

}  // namespace
}  // namespace raytracer::test

// Text that is not JSON, or is JSON to do harm with: what read_scene says, and how soon.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/cpu_stopwatch.h"
#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

/// A valid document with `members` added to its root, as text.
std::string with_members(const std::string& members) {
  return R"({"camera": {"origin": [1, 2, 3], "look_at": [0, 0, 0], "fov": 1, "width": 7,
             "height": 5})" +
         (members.empty() ? "" : ", " + members) + "}";
}

void expect_syntax_error(const std::string& text, const std::string& detail = "") {
  const std::vector<Error> errors = errors_of_text(text);
  ASSERT_EQ(errors.size(), 1U) << text.substr(0, 200) << '\n' << describe(errors);
  EXPECT_EQ(errors[0].kind, ErrorKind::syntax) << text.substr(0, 200);
  EXPECT_EQ(errors[0].pointer, "");
  ASSERT_TRUE(errors[0].syntax) << text.substr(0, 200);
  const auto& [line, column, reason] = *errors[0].syntax;
  EXPECT_EQ(errors[0].detail,
            fmt::format("not JSON: line {}, column {}: {}", line, column, reason));
  EXPECT_NE(errors[0].detail.find(detail), std::string::npos) << errors[0].detail;
}

/// Each pointer once, and no other; all of kind invalid.
void expect_invalid(const std::string& text, std::vector<std::string> pointers) {
  const std::vector<Error> errors = errors_of_text(text);
  std::vector<std::string> found;
  for (const Error& error : errors) {
    EXPECT_EQ(error.kind, ErrorKind::invalid);
    found.push_back(error.pointer);
  }
  std::sort(found.begin(), found.end());
  std::sort(pointers.begin(), pointers.end());
  EXPECT_EQ(found, pointers) << describe(errors);
}

double seconds_for(const std::string& text) {
  const CpuStopwatch watch;
  static_cast<void>(read_scene(text, {}));
  return watch.elapsed_ms() / 1000;
}

TEST(JsonText, that_is_empty_is_a_syntax_error) {
  expect_syntax_error("", "line 1, column 1: nothing is there");
  expect_syntax_error("   \n  ", "nothing is there");
}

TEST(JsonText, that_ends_early_is_a_syntax_error_at_any_length) {
  const std::string text = with_members(R"("name": "a\u00e4 b", "ambient": -1.5e3, "lights": [])");
  ASSERT_TRUE(errors_of_text(text).size() == 1);  // the ambient
  for (std::size_t size = 0; size < text.size(); ++size) expect_syntax_error(text.substr(0, size));
}

TEST(JsonText, with_any_byte_replaced_never_crashes) {
  const std::string text = with_members(R"("name": "a\u00e4", "objects": [{"type": "plane",
      "point": [0, 1e3, -2.5], "normal": [0, 1, 0], "material": {"color": "#ffeedd"}}])");
  ASSERT_TRUE(errors_of_text(text).empty());
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char byte : {'\0', '\xff', '\x80', '"', '{', ']', '9', '-', 'e', '\\'}) {
      std::string broken = text;
      broken[i] = byte;
      for (const Error& error : errors_of_text(broken)) EXPECT_FALSE(error.detail.empty());
    }
  }
}

TEST(JsonText, syntax_errors_say_line_and_column) {
  expect_syntax_error("{\n  \"camera\": ?\n}", "line 2, column 13");
  expect_syntax_error("?", "line 1, column 1");
  expect_syntax_error(std::string("{\n}\0 and more", 13), "line 2, column 2");
  expect_syntax_error(std::string("{}\0", 3), "line 1, column 3");
  expect_syntax_error(std::string("\0", 1), "line 1, column 1");
  expect_syntax_error("{\"a\": 1,\n\n}", "line 3, column 1: a comma too many");
  expect_syntax_error("[1, ]", "line 1, column 5: a comma too many");
  expect_syntax_error("{\"a\": }", "line 1, column 7: unexpected '}'");
  expect_syntax_error("{}\nx", "line 2, column 1");
}

TEST(JsonText, knows_no_nan_and_no_infinity) {
  for (const char* word : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-NaN"})
    expect_syntax_error(with_members("\"ambient\": " + std::string(word)));
}

TEST(JsonText, knows_no_other_extension_either) {
  for (const char* members :
       {"\"ambient\": 0x1", "\"ambient\": +1", "\"ambient\": .5", "\"ambient\": 5.",
        "\"ambient\": 01", "\"ambient\": 1,", "'ambient': 1", "ambient: 1",
        "\"ambient\": 1 // comment", "\"ambient\": 1 /* comment */", "\"ambient\": 1 1",
        "\"name\": \"a\nb\"", "\"name\": \"\\x\"", "\"name\": \"\\ud800\""})
    expect_syntax_error(with_members(members));
  expect_syntax_error(with_members("") + "x");
  expect_syntax_error(with_members("") + with_members(""));
}

TEST(JsonText, that_is_not_utf8_is_a_syntax_error) {
  for (const char* bytes : {"\xff", "\xc3", "\xc3\x28", "\xe2\x82", "\xf0\x90\x28\xbc", "\x80"}) {
    expect_syntax_error(with_members("\"name\": \"" + std::string(bytes) + "\""));
    expect_syntax_error(with_members("\"name\": " + std::string(bytes)));
  }
}

TEST(JsonText, with_a_byte_order_mark_is_read) {
  EXPECT_TRUE(errors_of_text("\xef\xbb\xbf" + with_members("")).empty());
}

TEST(JsonText, may_hold_any_character_in_a_name) {
  EXPECT_TRUE(
      errors_of_text(with_members("\"name\": \"\xc3\xa4 \xf0\x9f\x98\x80 \\u0000 \\ud83d\\ude00\""))
          .empty());
}

TEST(DuplicateKey, is_refused_at_any_level_with_its_pointer) {
  expect_invalid(with_members(R"("ambient": 1, "ambient": 1)"), {"/ambient"});
  expect_invalid(with_members(R"("ambient": 1, "\u0061mbient": 1)"), {"/ambient"});
  expect_invalid(with_members(R"("materials": {"a/b~": {}, "c": {}, "a/b~": {}})"),
                 {"/materials/a~1b~0"});
  expect_invalid(with_members(R"("objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
                                              "material": {"kd": 1, "kd": 1}}])"),
                 {"/objects/0/material/kd"});
  expect_invalid(with_members(R"("lights": [{"type": "point", "position": [0, 0, 0]},
                                            {"type": "point", "position": [0, 0, 0],
                                             "type": "point"}])"),
                 {"/lights/1/type"});
}

TEST(DuplicateKey, is_refused_in_an_unknown_part_too) {
  const std::vector<Error> errors = errors_of_text(with_members(R"("x": {"a": 1, "a": 2})"));
  ASSERT_EQ(errors.size(), 2U) << describe(errors);
}

TEST(DuplicateKey, is_reported_together_with_other_errors) {
  expect_invalid(with_members(R"("name": "a", "name": "b", "ambient": -1, "ligths": [])"),
                 {"/name", "/ambient", "/ligths"});
}

TEST(DuplicateKey, is_found_among_many_keys_in_time) {
  std::string members = "\"materials\": {";
  for (int i = 0; i < 100'000; ++i) members += "\"m" + std::to_string(i) + "\": {}, ";
  members += "\"m77777\": {}}";
  const std::string text = with_members(members);
  EXPECT_LT(seconds_for(text), 3);
  expect_invalid(text, {"/materials/m77777"});
}

TEST(HugeNumber, is_invalid_at_its_place_and_nothing_else) {
  expect_invalid(with_members("\"ambient\": 1e400"), {"/ambient"});
  expect_invalid(with_members("\"ambient\": -1e400"), {"/ambient"});
  expect_invalid(with_members("\"background\": [0, 1e400, 0]"), {"/background/1"});
  expect_invalid(with_members("\"materials\": {\"a/b\": {\"kd\": 1e999999999}}"),
                 {"/materials/a~1b/kd"});
  expect_invalid(with_members(R"("objects": [{"type": "sphere", "center": [0, 0, 0],
                                              "radius": 1e309}])"),
                 {"/objects/0/radius"});
  expect_invalid(with_members("\"render\": {\"samples\": 1e400}"), {"/render/samples"});
}

TEST(HugeNumber, written_out_in_digits_is_invalid_too) {
  expect_invalid(with_members("\"ambient\": 1" + std::string(400, '0')), {"/ambient"});
  expect_invalid(with_members("\"ambient\": " + std::string(100'000, '9') + ".5"), {"/ambient"});
}

TEST(HugeNumber, in_a_direction_is_no_zero_vector) {
  expect_invalid(with_members(R"("lights": [{"type": "distant", "direction": [1e400, 0, 0]}])"),
                 {"/lights/0/direction/0"});
}

TEST(HugeNumber, in_the_origin_is_not_the_look_at) {
  expect_invalid(R"({"camera": {"origin": [1e400, 0, 0], "look_at": [0, 0, 0], "fov": 1,
                                "width": 7, "height": 5}})",
                 {"/camera/origin/0"});
}

TEST(HugeNumber, comes_with_the_documents_other_errors) {
  expect_invalid(with_members(R"("ambient": 1e400, "background": [0, -1e400, 5], "x": 1,
                                 "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": -1,
                                              "material": "none"}])"),
                 {"/ambient", "/background/1", "/background/2", "/x", "/objects/0/radius",
                  "/objects/0/material"});
}

TEST(HugeNumber, in_many_places_comes_with_the_documents_other_errors) {
  std::string members = "\"x\": 1, \"objects\": [";
  std::vector<std::string> pointers{"/x", "/ambient"};
  for (int i = 0; i < 40; ++i) {
    members += R"({"type": "sphere", "center": [0, 1e400, 0], "radius": 1}, )";
    pointers.push_back("/objects/" + std::to_string(i) + "/center/1");
  }
  members += R"({"type": "sphere", "center": [0, 0, 0], "radius": 1}], "ambient": -1)";
  expect_invalid(with_members(members), pointers);
}

TEST(HugeNumber, in_a_thousand_places_behind_a_long_text_is_refused_in_seconds) {
  std::string members = "\"x\": [0";
  for (int i = 0; i < 2'000'000; ++i) members += ",0";
  for (int i = 0; i < 1000; ++i) members += ",1e400";
  EXPECT_LT(seconds_for(with_members(members + "]")), 8);
}

TEST(HugeNumber, in_a_string_is_a_string) {
  EXPECT_TRUE(errors_of_text(with_members("\"name\": \"1e400\"")).empty());
  EXPECT_TRUE(errors_of_text(with_members("\"materials\": {\"1e400\": {}}")).empty());
  expect_invalid(with_members("\"materials\": {\"1e400\": {\"kd\": 1e400}}, \"name\": \"1e400\""),
                 {"/materials/1e400/kd"});
  expect_invalid(with_members("\"name\": \"\xc3\xa4\", \"ambient\": 1e400"), {"/ambient"});
}

TEST(HugeNumber, before_a_syntax_error_is_a_syntax_error) {
  expect_syntax_error(with_members("\"ambient\": 1e400, ?"));
}

TEST(HugeNumber, after_a_byte_order_mark_is_found_too) {
  expect_invalid("\xef\xbb\xbf" + with_members("\"ambient\": 1e400"), {"/ambient"});
}

TEST(TinyNumber, is_zero) {
  const Scene scene = scene_of_text(with_members("\"ambient\": 1e-400"));
  EXPECT_EQ(scene.ambient, 0);
  expect_invalid(with_members(R"("objects": [{"type": "sphere", "center": [0, 0, 0],
                                              "radius": 1e-400}])"),
                 {"/objects/0/radius"});
}

class NestingBomb : public testing::TestWithParam<std::string> {};

TEST_P(NestingBomb, is_refused_quickly) {
  const std::string& opening = GetParam();
  std::string bomb;
  for (int i = 0; i < 100'000; ++i) bomb += opening;
  for (const std::string& text : {bomb, with_members("\"objects\": " + bomb)}) {
    EXPECT_LT(seconds_for(text), 1);
    const std::vector<Error> errors = errors_of_text(text);
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_NE(errors[0].detail.find("nested"), std::string::npos) << errors[0].detail;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, NestingBomb,
                         testing::Values("[", "{\"a\":", "[{\"a\":", "{\"\":[", "[[],"),
                         [](const auto& opening) { return std::to_string(opening.index); });

TEST(NestingBomb, that_is_closed_is_refused_too) {
  expect_invalid(with_members("\"objects\": " + std::string(63, '[') + std::string(63, ']')),
                 {"/objects/0"});
  const std::vector<Error> errors =
      errors_of_text(with_members("\"objects\": " + std::string(64, '[') + std::string(64, ']')));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NE(errors[0].detail.find("nested"), std::string::npos) << errors[0].detail;
}

TEST(HugeDocument, of_a_quarter_million_spheres_is_read_in_seconds) {
  std::string text = R"({"camera": {"origin": [0, 0, 0], "look_at": [0, 0, 1], "fov": 1,
                         "width": 7, "height": 5}, "materials": {"red": {}}, "objects": [)";
  for (int i = 0; i < 250'000; ++i) {
    if (i > 0) text += ',';
    text += R"({"type": "sphere", "center": [)" + std::to_string(i * 0.001) + ", " +
            std::to_string(i * 0.5) + R"(, -3.25], "radius": 0.5, "material": "red"})";
  }
  text += "]}";
  ASSERT_GT(text.size(), 18U << 20);
  const CpuStopwatch watch;
  const Scene scene = scene_of_text(text);
  EXPECT_EQ(scene.objects.size(), 250'000U);
  EXPECT_EQ(scene.materials.size(), 1U);
  EXPECT_LT(watch.elapsed_ms(), 8000);
}

TEST(HugeDocument, of_errors_is_refused_in_seconds) {
  std::string members = "\"objects\": [0";
  for (int i = 0; i < 2'000'000; ++i) members += ",0";
  EXPECT_LT(seconds_for(with_members(members + "]")), 8);
}

TEST(HugeDocument, of_duplicates_is_refused_in_seconds) {
  std::string members = "\"a\": 0";
  for (int i = 0; i < 500'000; ++i) members += ",\"a\":0";
  const std::string text = with_members(members);
  EXPECT_LT(seconds_for(text), 8);
  EXPECT_EQ(errors_of_text(text).size(), 1001U);
}

}  // namespace
}  // namespace raytracer::test

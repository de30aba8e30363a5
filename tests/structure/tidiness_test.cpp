// What no file has: too many lines, notes of unfinished work, or no word about itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "tests/structure/source_tree.h"

namespace raytracer::test {
namespace {

std::vector<SourceFile> all_files() {
  return source_files({"engine", "server", "client", "web", "tests"});
}

bool is_cpp(const SourceFile& file) {
  return file.path.ends_with(".h") || file.path.ends_with(".cpp");
}

TEST(Tidiness, no_file_has_400_lines) {
  for (const SourceFile& file : all_files()) {
    if (file.path.starts_with("server/scenes/")) continue;  // data: a mesh is as long as it is
    EXPECT_LT(std::count(file.text.begin(), file.text.end(), '\n'), 400) << file.path;
  }
}

TEST(Tidiness, nothing_is_left_to_do) {
  // In two parts, so that this file does not say them.
  for (const std::string& word : {std::string("TO") + "DO", std::string("FIX") + "ME"})
    for (const SourceFile& file : all_files())
      EXPECT_EQ(file.text.find(word), std::string::npos) << file.path << " says " << word;
}

TEST(Tidiness, header_is_included_once) {
  for (const SourceFile& file : all_files()) {
    // A kernel's "-inl.h" is included again, once for each instruction set.
    if (!file.path.ends_with(".h") || file.path.ends_with("-inl.h")) continue;
    EXPECT_NE(file.text.find("#pragma once\n"), std::string::npos) << file.path;
  }
}

TEST(Tidiness, file_says_what_it_is) {
  // A source with its own header says it there.
  const std::vector<SourceFile> files = all_files();
  for (const SourceFile& file : files) {
    if (!is_cpp(file) || file.text.starts_with("//")) continue;
    const std::string header = file.path.substr(0, file.path.rfind('.')) + ".h";
    EXPECT_TRUE(file.path != header &&
                std::any_of(files.begin(), files.end(),
                            [&](const SourceFile& other) { return other.path == header; }))
        << file.path << " begins without a comment and has no header that does";
  }
}

/// Two types of one name and namespace are one to the linker, which keeps either's functions: no
/// compiler sees it. A specialization is a type of its own.
TEST(Tidiness, headers_define_each_type_once) {
  static const std::regex definition(
      R"(\n(?:struct|class|enum class) (?:alignas\(\w+\) )?(\w+(?:::\w+)*(?:<[^;{]*>)?)[^;{]*\{)");
  static const std::regex name_space(R"(\nnamespace ([\w:]+) \{)");
  std::map<std::string, std::string> defined_in;
  for (const SourceFile& file : source_files({"engine", "server", "client"})) {
    if (!file.path.ends_with(".h")) continue;
    std::smatch inside;
    if (!std::regex_search(file.text, inside, name_space)) continue;  // includes others only
    for (std::sregex_iterator i(file.text.begin(), file.text.end(), definition), end; i != end;
         ++i) {
      // Of the kernel there is one for each instruction set.
      const std::string scope = file.path.ends_with("-inl.h") ? "simd" : inside[1].str();
      const auto [other, is_new] = defined_in.try_emplace(scope + "::" + (*i)[1].str(), file.path);
      EXPECT_TRUE(is_new) << other->first << " is in " << other->second << " and in " << file.path;
    }
  }
  EXPECT_GT(defined_in.size(), 100U);
}

TEST(Tidiness, no_document_but_those_that_are_here_is_named) {
  static const std::regex name(R"([a-z_-]+\.md\b)");
  for (const SourceFile& file : all_files())
    for (std::sregex_iterator i(file.text.begin(), file.text.end(), name), end; i != end; ++i)
      EXPECT_EQ(i->str(), "extremes.md") << file.path << " names it";
}

TEST(Tidiness, no_file_name_says_nothing) {
  for (const SourceFile& file : all_files())
    for (const char* const word : {"util", "helper", "manager", "common", "misc"})
      EXPECT_EQ(file.path.find(word), std::string::npos) << file.path;
}

TEST(Tidiness, text_is_utf8_without_tabs_or_trailing_spaces) {
  for (const SourceFile& file : all_files()) {
    EXPECT_EQ(file.text.find('\t'), std::string::npos) << file.path;
    EXPECT_EQ(file.text.find('\r'), std::string::npos) << file.path;
    EXPECT_EQ(file.text.find(" \n"), std::string::npos) << file.path;
    EXPECT_TRUE(file.text.empty() || file.text.ends_with('\n')) << file.path;
  }
}

}  // namespace
}  // namespace raytracer::test

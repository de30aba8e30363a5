// A kind of object, light or material is told in its own folder: nothing else names it but the
// lists of all kinds, so that one more is a folder and a line in each list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/structure/source_tree.h"

namespace raytracer::test {
namespace {

/// The lists of all kinds.
const std::set<std::string> lists{
    "engine/objects/objects.h",     "engine/objects/packets.h",
    "engine/objects/objects-inl.h", "engine/objects/sweeps-inl.h",
    "engine/lights/lights.h",       "engine/lights/lights-inl.h",
    "engine/materials/materials.h", "engine/materials/materials-inl.h"};

/// Kinds whose name is no word of geometry or of a document, so that nobody else needs it even in
/// words.
const std::set<std::string> unheard_of{"engine/objects/cylinder/"};

/// "engine/objects/sphere/" of what is in a kind's folder, else nothing.
std::string kind_folder_of(const std::string& path) {
  static const std::regex folder(R"(engine/(objects|lights|materials)/\w+/)");
  std::smatch match;
  if (!std::regex_search(path, match, folder, std::regex_constants::match_continuous)) return {};
  return match.str();
}

/// The structures and enumerations that a header defines, but for specializations.
std::set<std::string> types_in(const SourceFile& header) {
  static const std::regex definition(
      R"(\n(?:struct|class|enum class) (?:alignas\(\w+\) )?(\w+)(?![\w<:])[^;{]*\{)");
  const std::string code = header.code();
  std::set<std::string> names;
  for (std::sregex_iterator match(code.begin(), code.end(), definition), end; match != end; ++match)
    names.insert(match->str(1));
  return names;
}

/// The types of each kind, by its folder.
std::map<std::string, std::set<std::string>> types_of_kinds(const std::vector<SourceFile>& files) {
  std::map<std::string, std::set<std::string>> types;
  for (const SourceFile& file : files) {
    const std::string folder = kind_folder_of(file.path);
    if (!folder.empty() && file.path.ends_with(".h")) types[folder].merge(types_in(file));
  }
  return types;
}

std::set<std::string> words_in(const std::string& text) {
  static const std::regex word(R"(\w+)");
  std::set<std::string> words;
  for (std::sregex_iterator match(text.begin(), text.end(), word), end; match != end; ++match)
    words.insert(match->str());
  return words;
}

TEST(Kinds, are_named_by_their_own_folder_and_the_lists_only) {
  const std::vector<SourceFile> files = source_files({"engine"});
  const auto types = types_of_kinds(files);
  for (const char* const type : {"Sphere", "Spheres", "PackedSphere", "SphereKind", "SphereItem"})
    EXPECT_TRUE(types.at("engine/objects/sphere/").contains(type)) << type;
  EXPECT_GE(types.size(), 8U) << "where are the kinds?";
  for (const SourceFile& file : files) {
    if (lists.contains(file.path)) continue;
    const std::set<std::string> words = words_in(file.code());
    for (const auto& [folder, names] : types) {
      if (file.path.starts_with(folder)) continue;
      for (const std::string& name : names)
        EXPECT_FALSE(words.contains(name)) << file.path << " names " << name << " of " << folder;
    }
  }
}

TEST(Kinds, have_a_type_of_their_own_each) {
  for (const auto& [folder, names] : types_of_kinds(source_files({"engine"})))
    EXPECT_FALSE(names.empty()) << folder;
}

TEST(Kinds, are_included_by_their_own_folder_and_the_lists_only) {
  int count = 0;
  for (const SourceFile& file : source_files({"engine", "server", "client"})) {
    for (const std::string& include : file.own_includes()) {
      const std::string folder = kind_folder_of(include);
      if (folder.empty()) continue;
      ++count;
      EXPECT_TRUE(file.path.starts_with(folder) || lists.contains(file.path))
          << file.path << " includes " << include;
    }
  }
  EXPECT_GT(count, 20);
}

TEST(Kinds, that_are_new_are_unheard_of_elsewhere) {
  const std::vector<SourceFile> files = source_files({"engine"});
  for (const std::string& folder : unheard_of) {
    const bool is_there = std::any_of(files.begin(), files.end(), [&](const SourceFile& file) {
      return file.path.starts_with(folder);
    });
    if (!is_there) continue;
    const std::string word = folder.substr(0, folder.size() - 1);
    const std::string name = word.substr(word.rfind('/') + 1);
    for (const SourceFile& file : files) {
      if (file.path.starts_with(folder) || lists.contains(file.path)) continue;
      std::string text = file.text;
      std::transform(text.begin(), text.end(), text.begin(),
                     [](unsigned char letter) { return std::tolower(letter); });
      EXPECT_EQ(text.find(name), std::string::npos) << file.path << " says " << name;
    }
  }
}

}  // namespace
}  // namespace raytracer::test

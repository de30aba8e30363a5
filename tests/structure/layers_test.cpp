// Which folder may include which: the arrows of the house, and no other.
//
// math -> scene -> plan -> kernel -> accel -> sample -> render -> engine.h -> server; image stands
// beside and knows scenes only. The client and the page speak HTTP and know nothing of either.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "tests/structure/source_tree.h"

namespace raytracer::test {
namespace {

using Folders = std::set<std::string>;

/// The folders that each folder of the engine may include, itself aside.
const std::map<std::string, Folders> engine_arrows{
    {"engine/math", {}},
    {"engine/scene", {"engine/math"}},
    {"engine/image", {"engine/math", "engine/scene"}},
    {"engine/plan", {"engine/math", "engine/scene"}},
    {"engine/kernel", {"engine/math", "engine/scene", "engine/plan"}},
    {"engine/accel", {"engine/math", "engine/scene", "engine/plan", "engine/kernel"}},
    {"engine/sample",
     {"engine/math", "engine/scene", "engine/plan", "engine/kernel", "engine/accel",
      "engine/image"}},
    {"engine/render",
     {"engine/math", "engine/scene", "engine/plan", "engine/kernel", "engine/accel",
      "engine/sample", "engine/image"}},
    {"engine/measure",
     {"engine/math", "engine/scene", "engine/plan", "engine/kernel", "engine/accel",
      "engine/sample", "engine/image", "engine/render"}},
};

/// "engine/kernel/simd/x.h" belongs to "engine/kernel".
std::string layer_of(const std::string& path) {
  const std::size_t first = path.find('/');
  return path.substr(0, path.find('/', first + 1));
}

TEST(Layers, engine_folders_include_only_what_is_below_them) {
  int count = 0;
  for (const SourceFile& file : source_files({"engine"})) {
    const std::string layer = layer_of(file.path);
    if (folder_of(file.path) == "engine") continue;  // engine.h and the build's identity
    ASSERT_TRUE(engine_arrows.contains(layer))
        << file.path << ": say in layers_test.cpp where " << layer << " stands";
    for (const std::string& include : file.own_includes()) {
      const std::string target = layer_of(include);
      EXPECT_TRUE(target == layer || engine_arrows.at(layer).contains(target))
          << file.path << " includes " << include;
      ++count;
    }
  }
  EXPECT_GT(count, 100) << "where is the engine?";
}

TEST(Layers, engine_knows_nothing_of_its_users) {
  for (const SourceFile& file : source_files({"engine"}))
    for (const std::string& include : file.own_includes())
      EXPECT_TRUE(include.starts_with("engine/")) << file.path << " includes " << include;
}

TEST(Layers, server_includes_one_header_of_the_engine) {
  int count = 0;
  for (const SourceFile& file : source_files({"server"}))
    for (const std::string& include : file.own_includes()) {
      EXPECT_TRUE(include.starts_with("server/") || include == "engine/engine.h")
          << file.path << " includes " << include;
      count += include == "engine/engine.h";
    }
  EXPECT_GT(count, 0);
}

TEST(Layers, client_includes_neither_engine_nor_server) {
  int count = 0;
  for (const SourceFile& file : source_files({"client"}))
    for (const std::string& include : file.own_includes()) {
      EXPECT_TRUE(include.starts_with("client/")) << file.path << " includes " << include;
      ++count;
    }
  EXPECT_GT(count, 0);
}

TEST(Layers, client_links_neither_engine_nor_server) {
  for (const SourceFile& file : source_files({"client"})) {
    if (!file.path.ends_with("CMakeLists.txt")) continue;
    EXPECT_EQ(file.text.find("raytracer_engine"), std::string::npos) << file.path;
    EXPECT_EQ(file.text.find("raytracer_service"), std::string::npos) << file.path;
  }
}

TEST(Layers, includes_name_files_from_the_root) {
  const std::string root = RAYTRACER_SOURCE_DIR;
  for (const SourceFile& file : source_files({"engine", "server", "client", "tests"}))
    for (const std::string& include : file.own_includes())
      EXPECT_TRUE(std::filesystem::exists(root + "/" + include))
          << file.path << " includes " << include;
}

}  // namespace
}  // namespace raytracer::test

// Which folder may include which: the arrows of the house, and no other.
//
// math -> scene -> plan -> pack -> accel -> kernel -> sample -> render -> forecast -> tradeoff ->
// engine.h -> server. The stopwatches and the pool of threads stand below all of them; image stands
// beside and knows scenes only. The client and the page speak HTTP and know nothing of either;
// client/manual joins both programs' tables of options.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/structure/source_tree.h"

namespace raytracer::test {
namespace {

using Folders = std::set<std::string>;

/// The folders of the engine, each of which may include those before it.
const std::vector<std::string> engine_order{
    "engine/memory", "engine/measure", "engine/parallel", "engine/math",    "engine/scene",
    "engine/image",  "engine/plan",    "engine/pack",     "engine/accel",   "engine/kernel",
    "engine/sample", "engine/render",  "engine/forecast", "engine/tradeoff"};

/// Structures and kernels see packed arrays, never the scene. What they and the stages before the
/// plan make is the same at any time, so they measure none.
const std::map<std::string, Folders> further_refusals{
    {"engine/parallel", {"engine/measure"}},
    {"engine/math", {"engine/measure", "engine/parallel"}},
    {"engine/scene", {"engine/measure", "engine/parallel"}},
    {"engine/image", {"engine/measure"}},
    {"engine/plan", {"engine/image"}},
    {"engine/pack", {"engine/measure", "engine/image"}},
    {"engine/accel", {"engine/measure", "engine/scene", "engine/image"}},
    {"engine/kernel", {"engine/measure", "engine/scene"}},
};

bool may_include(const std::string& layer, const std::string& target) {
  if (layer == target) return true;
  const auto refused = further_refusals.find(layer);
  if (refused != further_refusals.end() && refused->second.contains(target)) return false;
  const auto place = [](const std::string& folder) {
    return std::find(engine_order.begin(), engine_order.end(), folder);
  };
  return place(target) < place(layer);
}

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
    ASSERT_EQ(std::count(engine_order.begin(), engine_order.end(), layer), 1)
        << file.path << ": say in layers_test.cpp where " << layer << " stands";
    for (const std::string& include : file.own_includes()) {
      const std::string target = layer_of(include);
      EXPECT_TRUE(may_include(layer, target)) << file.path << " includes " << include;
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

/// A tool of the build, which joins both programs' tables of options.
bool is_manual(const SourceFile& file) { return file.path.starts_with("client/manual/"); }

TEST(Layers, client_includes_neither_engine_nor_server) {
  int count = 0;
  for (const SourceFile& file : source_files({"client"})) {
    if (is_manual(file)) continue;
    for (const std::string& include : file.own_includes()) {
      EXPECT_TRUE(include.starts_with("client/")) << file.path << " includes " << include;
      ++count;
    }
  }
  EXPECT_GT(count, 0);
}

TEST(Layers, client_links_neither_engine_nor_server) {
  for (const SourceFile& file : source_files({"client"})) {
    if (is_manual(file) || !file.path.ends_with("CMakeLists.txt")) continue;
    EXPECT_EQ(file.text.find("raytracer_engine"), std::string::npos) << file.path;
    EXPECT_EQ(file.text.find("raytracer_service"), std::string::npos) << file.path;
  }
}

TEST(Layers, manual_sees_tables_of_options_and_names_of_scenes_only) {
  for (const SourceFile& file : source_files({"client/manual"}))
    for (const std::string& include : file.own_includes())
      EXPECT_TRUE(include.starts_with("client/manual/") || include == "client/arguments.h" ||
                  include == "server/config.h" || include == "server/catalog.h")
          << file.path << " includes " << include;
}

TEST(Layers, includes_name_files_from_the_root) {
  const std::filesystem::path root = RAYTRACER_SOURCE_DIR;
  for (const SourceFile& file : source_files({"engine", "server", "client", "tests"}))
    for (const std::string& include : file.own_includes())
      EXPECT_TRUE(std::filesystem::exists(root / include)) << file.path << " includes " << include;
}

}  // namespace
}  // namespace raytracer::test

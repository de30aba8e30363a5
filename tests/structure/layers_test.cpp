// Which folder may include which: the arrows of the house, and no other.
//
// math -> fields -> packets -> finders -> lights, materials, objects -> scene -> pack -> plan ->
// reference, kernel -> sample -> render -> forecast -> tradeoff -> engine.h -> server. Memory, the
// stopwatches, the pool of threads and words stand below all of them; image stands beside and knows
// scenes only. The "-inl.h" of a folder, the kernels' SIMD code, keep the same order. The client
// and the page speak HTTP and know nothing of either; client/manual joins both programs' tables of
// options.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/structure/source_tree.h"

namespace raytracer::test {
namespace {

using Folders = std::set<std::string>;

/// The folders of the engine, each of which may include those before it.
const std::vector<std::string> engine_order{
    "engine/memory",    "engine/measure",   "engine/parallel", "engine/text",    "engine/math",
    "engine/errors",    "engine/fields",    "engine/packets",  "engine/finders", "engine/lights",
    "engine/materials", "engine/objects",   "engine/scene",    "engine/image",   "engine/pack",
    "engine/plan",      "engine/reference", "engine/kernel",   "engine/sample",  "engine/render",
    "engine/forecast",  "engine/tradeoff"};

/// Finders know no kinds, and kernels see packed arrays, never the scene. What they and the stages
/// before the plan make is the same at any time, so they measure none.
const std::map<std::string, Folders> further_refusals{
    {"engine/parallel", {"engine/measure"}},
    {"engine/text", {"engine/measure", "engine/parallel"}},
    {"engine/math", {"engine/measure", "engine/parallel", "engine/text"}},
    {"engine/fields", {"engine/measure", "engine/parallel"}},
    {"engine/packets", {"engine/measure", "engine/parallel", "engine/fields"}},
    {"engine/finders", {"engine/measure", "engine/fields"}},
    {"engine/lights", {"engine/measure", "engine/parallel", "engine/finders"}},
    {"engine/materials", {"engine/measure", "engine/parallel", "engine/finders"}},
    {"engine/objects", {"engine/measure", "engine/materials"}},
    {"engine/scene", {"engine/measure", "engine/parallel", "engine/finders", "engine/packets"}},
    {"engine/image",
     {"engine/measure", "engine/finders", "engine/packets", "engine/lights", "engine/materials",
      "engine/objects"}},
    {"engine/pack", {"engine/measure", "engine/finders", "engine/packets", "engine/image"}},
    {"engine/plan", {"engine/measure", "engine/finders", "engine/packets", "engine/image"}},
    {"engine/reference", {"engine/measure", "engine/scene", "engine/image"}},
    {"engine/kernel", {"engine/measure", "engine/scene", "engine/reference"}},
};

/// Of what a folder refuses, the headers that it takes: what a scene needs is not the scene, and
/// the names of finders are none.
const std::set<std::pair<std::string, std::string>> exceptions{
    {"engine/kernel", "engine/scene/features.h"}, {"engine/plan", "engine/finders/finder.h"}};

/// "engine/kernel/simd/x.h" belongs to "engine/kernel".
std::string layer_of(const std::string& path) {
  const std::size_t first = path.find('/');
  return path.substr(0, path.find('/', first + 1));
}

bool may_include(const std::string& layer, const std::string& include) {
  const std::string target = layer_of(include);
  if (layer == target || exceptions.contains({layer, include})) return true;
  const auto refused = further_refusals.find(layer);
  if (refused != further_refusals.end() && refused->second.contains(target)) return false;
  const auto place = [](const std::string& folder) {
    return std::find(engine_order.begin(), engine_order.end(), folder);
  };
  return place(target) < place(layer);
}

bool is_simd(const std::string& path) { return path.ends_with("-inl.h"); }

TEST(Layers, engine_folders_include_only_what_is_below_them) {
  int count = 0;
  for (const SourceFile& file : source_files({"engine"})) {
    const std::string layer = layer_of(file.path);
    if (folder_of(file.path) == "engine") continue;  // engine.h and the build's identity
    ASSERT_EQ(std::count(engine_order.begin(), engine_order.end(), layer), 1)
        << file.path << ": say in layers_test.cpp where " << layer << " stands";
    for (const std::string& include : file.own_includes()) {
      EXPECT_TRUE(may_include(layer, include)) << file.path << " includes " << include;
      ++count;
    }
  }
  EXPECT_GT(count, 500) << "where is the engine?";
}

/// Which compile it once for each instruction set.
TEST(Layers, simd_code_is_included_by_sources_of_the_kernels_only) {
  for (const SourceFile& file : source_files({"engine", "server", "client", "tests"}))
    for (const std::string& include : file.own_includes()) {
      if (!is_simd(include) || is_simd(file.path)) continue;
      EXPECT_TRUE(file.path.starts_with("engine/kernel/simd/") && file.path.ends_with(".cpp"))
          << file.path << " includes " << include;
    }
}

/// They have no include guard. What several kernels need is read by the list of what they have in
/// common; the entries are the same in either precision.
TEST(Layers, simd_code_is_included_by_one_file_each) {
  std::map<std::string, std::set<std::string>> includers;
  for (const SourceFile& file : source_files({"engine"}))
    for (const std::string& include : file.own_includes())
      if (is_simd(include)) includers[include].insert(file.path);
  EXPECT_GT(includers.size(), 20U);
  includers.erase("engine/kernel/simd/kernel-inl.h");
  includers.erase("engine/kernel/simd/entries-inl.h");
  for (const auto& [part, files] : includers)
    EXPECT_EQ(files.size(), 1U) << part << " is also included by " << *files.rbegin();
}

/// Include guards would hide it.
TEST(Layers, no_header_includes_itself_by_way_of_others) {
  std::map<std::string, std::vector<std::string>> includes;
  for (const SourceFile& file : source_files({"engine", "server", "client"}))
    includes[file.path] = file.own_includes();
  std::set<std::string> finished;
  std::set<std::string> open;
  const std::function<void(const std::string&)> visit = [&](const std::string& path) {
    if (finished.contains(path)) return;
    open.insert(path);
    for (const std::string& include : includes[path]) {
      EXPECT_FALSE(open.contains(include)) << path << " includes " << include;
      if (!open.contains(include)) visit(include);
    }
    open.erase(path);
    finished.insert(path);
  };
  const auto files = includes;
  for (const auto& [path, of_it] : files) visit(path);
}

TEST(Layers, kinds_finders_and_kernels_never_name_the_scene) {
  static const std::regex scene(R"(\bScene\b)");
  for (const SourceFile& file :
       source_files({"engine/math", "engine/fields", "engine/finders", "engine/packets",
                     "engine/lights", "engine/materials", "engine/objects", "engine/kernel"}))
    EXPECT_FALSE(std::regex_search(file.code(), scene)) << file.path;
}

/// Nor do they know it by way of a header that includes it.
TEST(Layers, kernels_do_not_reach_the_scene) {
  std::map<std::string, std::vector<std::string>> includes;
  for (const SourceFile& file : source_files({"engine"})) includes[file.path] = file.own_includes();
  std::map<std::string, std::string> reached_from;
  const std::function<void(const std::string&)> visit = [&](const std::string& path) {
    for (const std::string& include : includes[path])
      if (reached_from.emplace(include, path).second) visit(include);
  };
  const auto files = includes;
  for (const auto& [path, of_it] : files)
    if (path.starts_with("engine/kernel/")) visit(path);
  EXPECT_TRUE(reached_from.contains("engine/scene/features.h")) << "which kernels do read";
  for (const char* const hidden : {"engine/scene/scene.h", "engine/scene/read_scene.h"})
    EXPECT_FALSE(reached_from.contains(hidden)) << hidden << ", by " << reached_from[hidden];
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
  for (const SourceFile& file : source_files({"client"})) {
    for (const std::string& include : file.own_includes()) {
      EXPECT_TRUE(include.starts_with("client/")) << file.path << " includes " << include;
      ++count;
    }
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
  const std::filesystem::path root = RAYTRACER_SOURCE_DIR;
  for (const SourceFile& file : source_files({"engine", "server", "client", "tests"}))
    for (const std::string& include : file.own_includes())
      EXPECT_TRUE(std::filesystem::exists(root / include)) << file.path << " includes " << include;
}

}  // namespace
}  // namespace raytracer::test

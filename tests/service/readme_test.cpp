// server/README.md: its Python works, and its tables have every request and every flag with its
// default; engine/scene/README.md has every key of a scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "tests/golden/picture.h"
#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;

const fs::path server_dir = fs::path(RAYTRACER_SOURCE_DIR) / "server";

std::string readme() { return read_file(server_dir / "README.md"); }

/// 16777216 as 16,777,216.
std::string with_commas(std::string digits) {
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

TEST(ServerReadme, python_posts_a_scene) {
  if (run({"python3", {"-c", "import urllib.request"}}).status != 0)
    GTEST_SKIP() << "there is no python3 here";
  const std::string text = readme();
  static const std::regex block("```python\n([^`]*)```");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(text, match, block));
  const ServerProcess server;
  const std::string program =
      std::regex_replace(match.str(1), std::regex("http://127.0.0.1:8080"), server.url());
  const TemporaryFolder folder;
  fs::create_directory_symlink(server_dir, folder.path() / "server");
  const Outcome outcome = run({"python3", {"-c", program}, "", {}, folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("samples per pixel: ")) << outcome.out;
  EXPECT_EQ(decode_png(read_file(folder.path() / "picture.png")).width, 700);
}

TEST(ServerReadme, table_has_every_request) {
  const ServerProcess server;
  const std::string text = readme();
  const nlohmann::json description = json_of(get(server, "/openapi.json"));
  std::size_t count = 0;
  for (const auto& [path, methods] : description.at("paths").items())
    for (const auto& [method, word] :
         {std::pair("get", "GET"), {"post", "POST"}, {"delete", "DELETE"}}) {
      if (path == "/" || !methods.contains(method)) continue;
      ++count;
      EXPECT_NE(text.find(fmt::format("`{} {}", word, path)), std::string::npos) << word << path;
    }
  EXPECT_GT(count, 15U);
}

/// The names under "properties", wherever they stand.
void add_keys(const nlohmann::json& schema, std::set<std::string>& keys) {
  if (!schema.is_structured()) return;
  if (schema.is_object() && schema.contains("properties"))
    for (const auto& [key, value] : schema.at("properties").items()) keys.insert(key);
  for (const nlohmann::json& part : schema) add_keys(part, keys);
}

TEST(SceneReadme, tables_have_every_key) {
  const ServerProcess server;
  const std::string text = read_file(server_dir.parent_path() / "engine/scene/README.md");
  std::set<std::string> keys;
  add_keys(json_of(get(server, "/schema/scene.json")), keys);
  EXPECT_GT(keys.size(), 50U);
  for (const std::string& key : keys)
    EXPECT_NE(text.find("`" + key + "`"), std::string::npos) << key;
}

TEST(ServerReadme, table_has_every_flag) {
  const std::string text = readme();
  const std::string help = run({RAYTRACER_SERVER_PATH, {"--help"}}).out;
  static const std::regex flag("\n  (--[a-z-]+)");
  for (std::sregex_iterator match(help.begin(), help.end(), flag), end; match != end; ++match)
    EXPECT_NE(text.find("`" + match->str(1) + "`"), std::string::npos) << match->str(1);
}

TEST(ServerReadme, table_has_every_limit) {
  const ServerProcess server;
  const std::string text = readme();
  const nlohmann::json version = json_of(get(server, "/version"));
  for (const nlohmann::json& limit : version.at("limits")) {
    const std::string row = "`" + limit.at("flag").get<std::string>() + "` | " +
                            with_commas(std::to_string(limit.at("value").get<long>())) + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace raytracer::test

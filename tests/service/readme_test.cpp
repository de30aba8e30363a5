// server/README.md: its Python works, and its table has every flag with its default.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

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

// Man pages and completions say what --help says, and the shells take them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

const fs::path manual_dir = RAYTRACER_MANUAL_DIR;
const Words commands{"render", "plan", "tradeoff", "validate", "scenes"};

/// The long flags that --help lists.
std::set<std::string> flags_of(const std::string& program, const Words& arguments) {
  const std::string help = run({program, arguments}).out;
  static const std::regex flag(R"(\n  (?:-\w,)?(--[a-z-]+))");
  std::set<std::string> flags;
  for (std::sregex_iterator match(help.begin(), help.end(), flag), end; match != end; ++match)
    flags.insert(match->str(1));
  return flags;
}

std::set<std::string> all_flags_of_client() {
  std::set<std::string> flags = flags_of(RAYTRACER_CLIENT_PATH, {"--help"});
  for (const std::string& command : commands)
    flags.merge(flags_of(RAYTRACER_CLIENT_PATH, {command, "--help"}));
  return flags;
}

Words shipped_scenes() {
  Words names;
  for (const auto& entry : fs::directory_iterator(fs::path(RAYTRACER_SOURCE_DIR) / "server/scenes"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// What the page says, without roff's own marks.
std::string page(const std::string& name) {
  const std::string roff = read_file(manual_dir / "man1" / name);
  return std::regex_replace(std::regex_replace(roff, std::regex(R"(\\f[BIR])"), ""),
                            std::regex(R"(\\-)"), "-");
}

/// `flag` stands there, and no longer one that begins alike.
bool names(const std::string& text, const std::string& flag) {
  return std::regex_search(text, std::regex("(^|[^a-z-])" + flag + "([^a-z-]|$)"));
}

/// What Tab offers after these words; the last of them is the one to be completed.
Words offers(const Words& words, const fs::path& folder = {}) {
  const std::string& program = words.front();
  std::string function = "_" + program;
  std::replace(function.begin(), function.end(), '-', '_');
  const std::string script =
      "source \"$1\" && function=$2 && shift 2 && COMP_WORDS=(\"$@\") && COMP_CWORD=$(($# - 1)) && "
      "\"$function\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
  Words arguments{"--norc", "-c", script, "bash", (manual_dir / "bash" / program).string(),
                  function};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const Outcome said = run({"bash", arguments, "", {}, folder});
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(said.err, "");
  Words lines;
  std::istringstream text(said.out);
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

TEST(ManPage, has_every_option_of_help) {
  const std::string client = page("raytracer.1");
  const std::set<std::string> flags = all_flags_of_client();
  EXPECT_GE(flags.size(), 12U);
  for (const std::string& flag : flags) EXPECT_TRUE(names(client, flag)) << flag;
  for (const std::string& command : commands)
    EXPECT_NE(client.find(".SS \"" + command + " "), std::string::npos) << command;
  for (const std::string& flag : flags_of(RAYTRACER_SERVER_PATH, {"--help"}))
    EXPECT_TRUE(names(page("raytracer-server.1"), flag)) << flag;
}

TEST(ManPage, has_every_variable_and_the_exit_statuses) {
  const std::string help = run({RAYTRACER_SERVER_PATH, {"--help"}}).out;
  static const std::regex variable("RAYTRACER_[A-Z_]+");
  int count = 0;
  for (std::sregex_iterator match(help.begin(), help.end(), variable), end; match != end; ++match) {
    EXPECT_NE(page("raytracer-server.1").find("\n" + match->str() + "\n"), std::string::npos)
        << match->str();
    ++count;
  }
  EXPECT_GE(count, 10);
  EXPECT_NE(page("raytracer.1").find("Exit status: 0; 1 "), std::string::npos);
}

TEST(Completions, have_every_option_of_help) {
  for (const char* const file : {"bash/raytracer", "zsh/_raytracer"}) {
    const std::string script = read_file(manual_dir / file);
    for (const std::string& flag : all_flags_of_client())
      EXPECT_TRUE(names(script, flag)) << file << ": " << flag;
  }
  for (const char* const file : {"bash/raytracer-server", "zsh/_raytracer-server"}) {
    const std::string script = read_file(manual_dir / file);
    for (const std::string& flag : flags_of(RAYTRACER_SERVER_PATH, {"--help"}))
      EXPECT_TRUE(names(script, flag)) << file << ": " << flag;
  }
}

TEST(BashCompletion, completes_commands) {
  EXPECT_EQ(offers({"raytracer", "re"}), Words{"render"});
  for (const std::string& command : commands) {
    const Words all = offers({"raytracer", ""});
    EXPECT_EQ(std::count(all.begin(), all.end(), command), 1) << command;
  }
}

TEST(BashCompletion, completes_options_of_each_command_and_their_values) {
  for (const std::string& command : commands)
    for (const std::string& flag : flags_of(RAYTRACER_CLIENT_PATH, {command, "--help"}))
      EXPECT_EQ(offers({"raytracer", command, flag}).at(0), flag) << command;
  EXPECT_EQ(offers({"raytracer", "plan", "--wat"}), Words{});
  EXPECT_EQ(offers({"raytracer", "render", "--precision", "s"}), Words{"single"});
  EXPECT_EQ(offers({"raytracer", "render", "--precision", "=", "s"}), Words{"single"});
  EXPECT_EQ(offers({"raytracer", "render", "--samples", ""}), Words{});
  EXPECT_EQ(offers({"raytracer-server", "--max-pi"}), Words{"--max-pixels"});
}

TEST(BashCompletion, completes_shipped_scenes_and_files) {
  const TemporaryFolder folder;
  EXPECT_EQ(offers({"raytracer", "render", ""}, folder.path()), shipped_scenes());
  EXPECT_EQ(offers({"raytracer", "--server", "http://host:1", "validate", "dem"}, folder.path()),
            Words{"demo"});
  folder.write("my scene.json", "{}");
  EXPECT_EQ(offers({"raytracer", "plan", "my"}, folder.path()), Words{"my scene.json"});
  EXPECT_EQ(offers({"raytracer", "render", "demo", "-o", "my"}, folder.path()),
            Words{"my scene.json"});
  EXPECT_EQ(offers({"raytracer", "scenes", ""}, folder.path()), Words{});
}

TEST(ZshCompletion, is_taken_by_zsh) {
  for (const char* const name : {"_raytracer", "_raytracer-server"}) {
    const std::string file = (manual_dir / "zsh" / name).string();
    const Outcome outcome = run({"zsh", {"-f", "-n", file}});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
}

}  // namespace
}  // namespace raytracer::test

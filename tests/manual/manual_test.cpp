// Man pages say what --help says, and so do the completions of both shells.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/process/program.h"
#include "tests/process/pseudo_terminal.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Words = std::vector<std::string>;

const fs::path manual_dir = RAYTRACER_MANUAL_DIR;
const Words commands{"render", "plan", "tradeoff", "validate", "convert", "scenes", "cluster"};

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
  const std::string roff = read_file(manual_dir / name);
  return std::regex_replace(std::regex_replace(roff, std::regex(R"(\\f[BIR])"), ""),
                            std::regex(R"(\\-)"), "-");
}

/// `flag` stands there, and no longer one that begins alike.
bool names(const std::string& text, const std::string& flag) {
  return std::regex_search(text, std::regex("(^|[^a-z-])" + flag + "([^a-z-]|$)"));
}

/// PATH with both programs, which the completions ask for what they take.
std::string path_with_programs() {
  return fs::path(RAYTRACER_CLIENT_PATH).parent_path().string() + ":" + std::getenv("PATH");
}

/// What Tab offers in bash after these words; the last of them is the one to be completed.
Words offers(const Words& words, const fs::path& folder = {}) {
  const std::string script =
      "source \"$1\" && shift && COMP_WORDS=(\"$@\") && COMP_CWORD=$(($# - 1)) && "
      "_raytracer \"$1\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
  Words arguments{"--norc", "-c", script, "bash", (manual_dir / "raytracer.bash").string()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const Outcome said = run({"bash", arguments, "", {{"PATH", path_with_programs()}}, folder});
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
    EXPECT_NE(client.find(".SS \"raytracer " + command + " "), std::string::npos) << command;
  for (const std::string& flag : flags_of(RAYTRACER_SERVER_PATH, {"--help"}))
    EXPECT_TRUE(names(page("raytracer-server.1"), flag)) << flag;
}

TEST(ManPage, has_every_variable_and_the_exit_statuses) {
  const std::string help = run({RAYTRACER_SERVER_PATH, {"--help"}}).out;
  static const std::regex variable("RAYTRACER_[A-Z_]+");
  int count = 0;
  for (std::sregex_iterator match(help.begin(), help.end(), variable), end; match != end; ++match) {
    EXPECT_NE(page("raytracer-server.1").find("(or " + match->str() + ")"), std::string::npos)
        << match->str();
    ++count;
  }
  EXPECT_GE(count, 10);
  EXPECT_NE(page("raytracer.1").find("Exit status: 0 success; 1 "), std::string::npos);
}

TEST(BashCompletion, completes_commands) {
  EXPECT_EQ(offers({"raytracer", "re"}), Words{"render"});
  for (const std::string& command : commands) {
    const Words all = offers({"raytracer", ""});
    EXPECT_EQ(std::count(all.begin(), all.end(), command), 1) << command;
  }
}

TEST(BashCompletion, completes_options_of_each_command_and_their_values) {
  for (const std::string& command : commands) {
    const Words offered = offers({"raytracer", command, "--"});
    for (const std::string& flag : flags_of(RAYTRACER_CLIENT_PATH, {command, "--help"}))
      EXPECT_EQ(std::count(offered.begin(), offered.end(), flag), 1) << command << ' ' << flag;
  }
  EXPECT_EQ(offers({"raytracer", "plan", "--watc"}), Words{});
  EXPECT_EQ(offers({"raytracer", "render", "--precision", "s"}), Words{"single"});
  EXPECT_EQ(offers({"raytracer", "render", "--precision", "=", "s"}), Words{"single"});
  EXPECT_EQ(offers({"raytracer", "render", "--samples", ""}), Words{});
  EXPECT_EQ(offers({"raytracer-server", "--max-pi"}), Words{"--max-pixels"});
  const Words of_server = offers({"raytracer-server", ""});
  for (const std::string& flag : flags_of(RAYTRACER_SERVER_PATH, {"--help"}))
    EXPECT_EQ(std::count(of_server.begin(), of_server.end(), flag), 1) << flag;
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
  EXPECT_EQ(offers({"raytracer", "convert", ""}, folder.path()), Words{"my scene.json"});
  EXPECT_EQ(offers({"raytracer", "scenes", ""}, folder.path()), Words{});
}

/// A zsh in a terminal, in a folder with one file.
class ZshCompletion : public testing::Test {
 protected:
  void SetUp() override {
    if (!PseudoTerminal::is_available()) GTEST_SKIP() << "there is no terminal: mount /dev/pts";
    folder_.write("my scene.json", "{}");
  }

  /// These keys and Tab bring `expected` to the screen.
  void expect_completion(const std::string& keys, const std::string& expected) const {
    PseudoTerminal terminal({"zsh",
                             {"-f", "-i"},
                             "",
                             {{"PATH", path_with_programs()}, {"TERM", "dumb"}},
                             folder_.path()},
                            200, 50);
    terminal.type("fpath=(" + manual_dir.string() +
                  " $fpath); autoload -U compinit; compinit -D -u; PROMPT='rea''dy> '\n");
    ASSERT_TRUE(terminal.shows("ready> ", 20s)) << terminal.screen();
    terminal.type(keys + "\t");
    EXPECT_TRUE(terminal.shows(expected, 20s)) << terminal.screen();
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(ZshCompletion, completes_commands) {
  expect_completion("raytracer re", "raytracer render ");
  expect_completion("raytracer --server http://host:1 v",
                    "raytracer --server http://host:1 validate ");
}

TEST_F(ZshCompletion, completes_options_with_what_help_says_and_their_values) {
  expect_completion("raytracer plan --", "--json         -- Print the plan as JSON");
  expect_completion("raytracer plan --pre", "raytracer plan --precision=");
  expect_completion("raytracer render --precision=s", "raytracer render --precision=single ");
  expect_completion("raytracer-server --max-pi", "raytracer-server --max-pixels=");
}

TEST_F(ZshCompletion, completes_shipped_scenes_and_files) {
  expect_completion("raytracer validate dem", "raytracer validate demo ");
  expect_completion("raytracer render my", "raytracer render my\\ scene.json ");
  expect_completion("raytracer convert my", "raytracer convert my\\ scene.json ");
  expect_completion("raytracer render demo -o my", "raytracer render demo -o my\\ scene.json ");
}

}  // namespace
}  // namespace raytracer::test

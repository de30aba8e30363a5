// Every command in the READMEs for users is run, so that none of them is wrong.
//
// What counts are the ```sh blocks. A block that has <!-- not run: REASON --> on the line before it
// is left out. The commands of all other blocks are run one after the other by sh, in a folder that
// holds links to everything in the source tree (build/ being the build under test), so that what
// they write does not stay. Each has to end with status 0. Four kinds are treated otherwise:
//
// - git clone is left out: the address is the reader's;
// - make TARGET and ./raytracer-demo take minutes and may need a network: `make -n` says that the
//   target exists, `bash -n` that the script can be read;
// - build/raytracer-server is started, with a free port in place of its own, and runs until the
//   end or the next one; "127.0.0.1:PORT" and "localhost:PORT" in what follows then mean it.
//
// `$ ` before a command is no part of it; every line that is not a comment is a command. A
// backslash at the end joins lines, and <<'WORD' takes all up to WORD.
#include <fmt/format.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/process/patience.h"
#include "tests/process/server_process.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const fs::path source_dir = RAYTRACER_SOURCE_DIR;

/// The commands of one block.
std::vector<std::string> commands_in(const std::string& block) {
  static const std::regex here_document(R"(<<\s*'(\w+)')");
  std::vector<std::string> commands;
  std::istringstream lines(block);
  std::string command;
  for (std::string line; std::getline(lines, line);) {
    if (command.empty() && line.starts_with("$ ")) line.erase(0, 2);
    if (command.empty() && (line.empty() || line[0] == '#')) continue;
    command += line;
    if (command.ends_with('\\')) {
      command.back() = ' ';
      continue;
    }
    std::smatch start;
    if (std::regex_search(command, start, here_document)) {
      const std::string end = start[1];
      for (line.clear(); line != end && std::getline(lines, line);) command += "\n" + line;
    }
    commands.push_back(command);
    command.clear();
  }
  return commands;
}

/// The commands of all blocks that are to be run.
std::vector<std::string> commands_of(const fs::path& file) {
  const std::string readme = read_file(source_dir / file);
  static const std::regex block(R"((<!-- not run: \S[^\n]* -->\n+)?```sh\n([^`]*)```)");
  std::vector<std::string> commands;
  for (std::sregex_iterator match(readme.begin(), readme.end(), block), end; match != end;
       ++match) {
    if (match->length(1) > 0) continue;
    for (std::string& command : commands_in(match->str(2))) commands.push_back(std::move(command));
  }
  return commands;
}

/// Links to all that is in the source tree, but build/ to the build under test.
void link_tree(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(source_dir)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("build") && name != ".git")
      fs::create_symlink(entry.path(), folder / name);
  }
  fs::create_directory(folder / "build");
  fs::create_symlink(RAYTRACER_SERVER_PATH, folder / "build/raytracer-server");
  fs::create_symlink(RAYTRACER_CLIENT_PATH, folder / "build/raytracer");
}

/// A reader of the README: a folder, and the server that was started last.
class Reader {
 public:
  Reader() { link_tree(folder_.path()); }

  void obey(const std::string& command) {
    SCOPED_TRACE(command);
    if (command.starts_with("git clone ")) return;
    if (command.starts_with("make") || command.starts_with("sudo make"))
      return void(
          expect_success(std::regex_replace(command, std::regex("^(sudo )?make"), "make -n")));
    if (command.starts_with("./raytracer-demo"))
      return void(expect_success("test -x raytracer-demo && bash -n raytracer-demo"));
    if (command.starts_with("build/raytracer-server") && !is_question(command))
      return start_server(command);
    const std::string out = expect_success(
        std::regex_replace(command, std::regex(R"((127\.0\.0\.1|localhost):\d{4,5})"), address_));
    // The mistakes are made on purpose, and the answer is to name both.
    if (command.find("objcets") == std::string::npos) return;
    ++mistakes_;
    for (const char* const place : {"\"/camera/fov\"", "\"/objcets\""})
      EXPECT_NE(out.find(place), std::string::npos) << out;
  }

  /// How many commands were mistakes on purpose.
  int mistakes() const { return mistakes_; }

 private:
  static bool is_question(const std::string& command) {
    return command.find("--help") != std::string::npos ||
           command.find("--version") != std::string::npos;
  }

  /// What the command writes.
  std::string expect_success(const std::string& command) {
    const Outcome outcome = run({"/bin/sh", {"-c", command}, "", {}, folder_.path()}, 60s);
    EXPECT_EQ(outcome.status, 0) << outcome.out.substr(0, 2000) << outcome.err;
    return outcome.out;
  }

  void start_server(std::string command) {
    static const std::regex port(R"( --port[ =]\d+)");
    static const std::regex background(R"( *&$)");
    command = std::regex_replace(std::regex_replace(command, port, ""), background, "");
    server_ = std::make_unique<Process>(Command{
        "/bin/sh", {"-c", "exec " + command}, "", {{"RAYTRACER_PORT", "0"}}, folder_.path()});
    static const std::regex greeting(R"(listening on http://[^:\s]+:(\d+)\n)");
    EXPECT_TRUE(eventually([&] {
      std::smatch match;
      const std::string said = server_->out();
      if (!std::regex_search(said, match, greeting)) return server_->wait(0ms).has_value();
      address_ = "127.0.0.1:" + match.str(1);
      return true;
    }));
    EXPECT_NE(server_->out(), "") << server_->err();
  }

  const TemporaryFolder folder_;
  std::unique_ptr<Process> server_;
  std::string address_ = "127.0.0.1:8080";
  int mistakes_ = 0;
};

TEST(Readme, every_command_works) {
  ASSERT_TRUE(fs::exists(source_dir / "README.md")) << "there is no README.md";
  const std::vector<std::string> commands = commands_of("README.md");
  EXPECT_GE(commands.size(), 3U) << "README.md has no ```sh blocks to speak of";
  Reader reader;
  for (const std::string& command : commands) reader.obey(command);
  EXPECT_EQ(reader.mistakes(), 1);
}

TEST(Readme, every_command_of_several_machines_works) {
  const std::vector<std::string> commands = commands_of("server/deploy/README.md");
  EXPECT_GE(commands.size(), 2U);
  Reader reader;
  for (const std::string& command : commands) reader.obey(command);
}

TEST(Readme, every_command_of_the_server_works) {
  const std::vector<std::string> commands = commands_of("server/README.md");
  EXPECT_GE(commands.size(), 2U);
  Reader reader;
  for (const std::string& command : commands) reader.obey(command);
}

TEST(Readme, every_file_that_it_links_to_is_there) {
  static const std::regex link(R"(\]\(([^)#:\s]+)(#[^)]*)?\))");
  for (const char* const file : {"README.md", "server/README.md", "engine/scene/README.md",
                                 "server/deploy/README.md", "client/README.md"}) {
    const std::string readme = read_file(source_dir / file);
    const fs::path folder = (source_dir / file).parent_path();
    for (std::sregex_iterator match(readme.begin(), readme.end(), link), end; match != end; ++match)
      EXPECT_TRUE(fs::exists(folder / match->str(1))) << file << ": " << match->str(1);
  }
}

TEST(Readme, says_the_choices_that_the_specification_left_open) {
  const std::string text = read_file(source_dir / "README.md");
  const std::size_t begin = text.find("Choices");
  ASSERT_NE(begin, std::string::npos);
  const std::string choices = text.substr(begin, text.find("\n## ", begin) - begin);
  for (const char* const choice :
       {"field of view", "\"shadows\": \"black\"", "epsilon", "target_rmse"})
    EXPECT_NE(choices.find(choice), std::string::npos) << choice;
}

TEST(ReadmeReader, joins_lines_and_leaves_comments_and_prompts_out) {
  EXPECT_EQ(commands_in("# a comment\n\n$ one \\\n  two\nthree\n"),
            (std::vector<std::string>{"one    two", "three"}));
}

TEST(ReadmeReader, takes_a_here_document_as_one_command) {
  EXPECT_EQ(commands_in("cat <<'END'\n# text\n\nEND\nnext\n"),
            (std::vector<std::string>{"cat <<'END'\n# text\n\nEND", "next"}));
}

TEST(ReadmeReader, notices_a_command_that_fails) {
  Reader reader;
  EXPECT_NONFATAL_FAILURE(reader.obey("build/raytracer validate nowhere.json"), "nowhere.json");
  EXPECT_NONFATAL_FAILURE(reader.obey("make no-such-target"), "no-such-target");
  EXPECT_NONFATAL_FAILURE(reader.obey("build/raytracer-server --no-such-flag &"), "no-such-flag");
}

}  // namespace
}  // namespace raytracer::test

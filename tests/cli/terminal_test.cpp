// In a terminal: the picture in the best way that it has, no larger than the window, and a progress
// bar.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/client.h"
#include "tests/process/patience.h"
#include "tests/process/pseudo_terminal.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

const char* const no_terminal = "there is no terminal: mount /dev/pts";

/// The lines without their colours.
std::vector<std::string> plain_lines(const std::string& screen) {
  static const std::regex control("\x1b\\[[0-9;?]*[A-Za-z]|\r");
  std::istringstream text(std::regex_replace(screen, control, ""));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// The widths in characters of the picture's lines, which come before the line that names its size.
std::vector<int> picture_rows(const std::string& screen) {
  std::vector<int> widths;
  for (const std::string& line : plain_lines(screen)) {
    if (line.find(" samples per pixel") != std::string::npos) break;
    // Each character of UTF-8 has one byte that continues none.
    if (!line.empty())
      widths.push_back(static_cast<int>(std::count_if(line.begin(), line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80;
      })));
  }
  return widths;
}

class Terminal : public Client {
 protected:
  using Environment = std::map<std::string, std::string>;

  /// The screen after `raytracer ARGUMENTS`, which ends well, in a terminal that says
  /// `about_itself`.
  std::string shown(std::vector<std::string> arguments, int columns, int rows,
                    const Environment& about_itself = {}) {
    Environment environment{{"RAYTRACER_SERVER", server().url()},
                            {"TERM", "xterm-256color"},
                            {"TERM_PROGRAM", ""},
                            {"LC_TERMINAL", ""},
                            {"KITTY_WINDOW_ID", ""},
                            {"TMUX", ""}};
    for (const auto& [name, value] : about_itself) environment[name] = value;
    PseudoTerminal terminal(client_command(std::move(arguments), "", environment), columns, rows);
    EXPECT_EQ(terminal.wait(20s), 0) << terminal.screen();
    return terminal.screen();
  }
  const TemporaryFolder folder_;
  const std::string scene_ = folder_.write("scene.json", small_scene);
};

TEST_F(Terminal, small_picture_is_shown_pixel_by_pixel) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", scene_}, 80, 24);
  EXPECT_EQ(picture_rows(screen), std::vector<int>(6, 16)) << "16 x 12 pixels are 6 lines of 16";
  EXPECT_NE(screen.find("38;2;0;0;255m"), std::string::npos) << "where is the blue background?";
  EXPECT_NE(screen.find("\x1b[0m"), std::string::npos) << "the colours outlast the picture";
}

TEST_F(Terminal, transparent_background_is_the_terminals_own) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string scene = folder_.write("transparent.json", transparent_scene);
  const std::string screen = shown({"render", scene}, 80, 24);
  EXPECT_EQ(picture_rows(screen), std::vector<int>(6, 16));
  EXPECT_NE(screen.find("8;2;255;0;0m"), std::string::npos) << "where is the red sphere?";
  EXPECT_EQ(screen.find("48;2;0;0;0"), std::string::npos) << "no cell is black";
}

TEST_F(Terminal, large_picture_fits_the_window) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  for (const auto& [columns, rows] :
       std::vector<std::pair<int, int>>{{80, 24}, {40, 50}, {200, 12}}) {
    const std::vector<int> picture =
        picture_rows(shown({"render", scene_, "--width", "700", "--height", "500"}, columns, rows));
    ASSERT_FALSE(picture.empty());
    EXPECT_LE(picture.size(), static_cast<std::size_t>(rows)) << columns << " x " << rows;
    EXPECT_GE(picture.size(), 3U);
    for (const int width : picture) EXPECT_LE(width, columns);
    // A cell holds two pixels one above the other.
    const double ratio = picture.front() / (2.0 * static_cast<double>(picture.size()));
    EXPECT_NEAR(ratio, 700.0 / 500.0, 0.25);
  }
}

TEST_F(Terminal, colours_are_those_that_it_has) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string in_256 = shown({"render", scene_}, 80, 24, {{"TERM", "xterm"}});
  EXPECT_NE(in_256.find("38;5;"), std::string::npos) << in_256;
  EXPECT_EQ(in_256.find("38;2;"), std::string::npos) << in_256;
  const std::string in_16 = shown({"render", scene_}, 80, 24, {{"TERM", "linux"}});
  EXPECT_EQ(in_16.find("38;"), std::string::npos) << in_16;
  EXPECT_EQ(picture_rows(in_16), std::vector<int>(6, 16));
}

TEST_F(Terminal, no_bytes_of_an_image_file_reach_it) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", scene_}, 80, 24);
  EXPECT_EQ(screen.find("PNG"), std::string::npos);
  EXPECT_EQ(screen.find("P6"), std::string::npos);
  EXPECT_EQ(screen.find('\0'), std::string::npos);
}

TEST_F(Terminal, what_came_of_it_is_said_below_the_picture) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", scene_}, 80, 24);
  EXPECT_GT(screen.find("16 x 12"), screen.rfind("\x1b[0m")) << screen;
}

TEST_F(Terminal, picture_in_a_file_is_not_shown_too) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", scene_, "-o", folder_ / "image.png"}, 80, 24);
  EXPECT_EQ(picture_rows(screen), std::vector<int>());
  EXPECT_FALSE(read_file(folder_ / "image.png").empty());
}

TEST_F(Terminal, long_render_shows_a_bar_that_grows_and_goes) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  // By time, so that it is long enough however fast the engine is, and with much to refine; longer
  // where the machine is too busy to hear of progress.
  std::string screen;
  std::vector<int> percents;
  for (int budget_ms = 2000; percents.size() < 2 && budget_ms <= 8000; budget_ms *= 2) {
    screen = shown({"render", "demo", "-o", folder_ / "image.png", "--width", "700", "--height",
                    "500", "--budget-ms", std::to_string(budget_ms)},
                   80, 24);
    static const std::regex bar(R"(rendering \[#*-*\]\s+(\d+) %)");
    percents.clear();
    for (std::sregex_iterator match(screen.begin(), screen.end(), bar), end; match != end; ++match)
      percents.push_back(std::stoi(match->str(1)));
  }
  ASSERT_GE(percents.size(), 2U) << "no progress is seen";
  EXPECT_TRUE(std::is_sorted(percents.begin(), percents.end()));
  EXPECT_GT(percents.back(), percents.front());
  EXPECT_LE(percents.back(), 100);
  // Every line of the bar is overwritten, the last one erased.
  const std::size_t last = screen.rfind(" %");
  EXPECT_NE(screen.find("\r\x1b[K", last), std::string::npos) << screen;
}

TEST_F(Terminal, bar_fits_a_narrow_window) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  PseudoTerminal terminal(client_command({"render", folder_.write("long.json", endless_scene()),
                                          "-o", folder_ / "image.png"},
                                         "", {{"RAYTRACER_SERVER", server().url()}}),
                          20, 10);
  EXPECT_TRUE(terminal.shows(" %", 10s));
  terminal.type("\x03");
  EXPECT_EQ(terminal.wait(10s), 128 + SIGINT);
  std::string line;
  for (const char c : terminal.screen()) {
    if (c == '\r' || c == '\n') line.clear();
    if (c != '\r' && c != '\n') line += c;
    if (line.find("\x1b[K") != std::string::npos) line.erase(line.find("\x1b[K"));
    EXPECT_LT(line.find('\x1b') == std::string::npos ? line.size() : 0, 20U) << line;
  }
}

TEST_F(Terminal, without_one_there_is_no_bar) {
  const Outcome outcome = run_with_server(
      {"render", scene_, "--width", "700", "--height", "500", "--budget-ms", "900"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
  EXPECT_EQ(outcome.err.find('['), std::string::npos) << outcome.err;
}

TEST_F(Terminal, one_that_decodes_images_gets_one) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  // 16 x 12 pixels: two cells of 10 x 20, which the image fills.
  for (const Environment& kitty :
       {Environment{{"TERM", "xterm-kitty"}}, Environment{{"KITTY_WINDOW_ID", "1"}},
        Environment{{"TERM", "xterm-ghostty"}}}) {
    const std::string screen = shown({"render", scene_}, 80, 24, kitty);
    EXPECT_NE(screen.find("\x1b_Ga=T,f=32,s=20,v=20,c=2,r=1"), std::string::npos) << screen;
  }
  const std::string screen = shown({"render", scene_}, 80, 24, {{"TERM_PROGRAM", "iTerm.app"}});
  EXPECT_NE(screen.find("\x1b]1337;File=inline=1;width=2;height=1"), std::string::npos) << screen;
}

TEST_F(Terminal, large_image_fits_its_rows) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", "demo"}, 80, 24, {{"TERM", "xterm-kitty"}});
  EXPECT_NE(screen.find(",c=58,r=21,"), std::string::npos) << "21 rows of 700 x 500";
  EXPECT_NE(screen.find("m=0\x1b\\"), std::string::npos) << "the image does not end";
}

TEST_F(Terminal, one_with_sixels_gets_them) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", scene_}, 80, 24, {{"TERM", "foot"}});
  EXPECT_NE(screen.find("\x1bP0;1;0q\"1;1;20;"), std::string::npos) << screen;
  EXPECT_NE(screen.find("\x1b\\"), std::string::npos) << "the sixels do not end";
}

TEST_F(Terminal, multiplexer_gets_blocks) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen =
      shown({"render", scene_}, 80, 24, {{"KITTY_WINDOW_ID", "1"}, {"TMUX", "/tmp/x"}});
  EXPECT_EQ(picture_rows(screen), std::vector<int>(6, 16));
}

TEST_F(Terminal, dumb_one_gets_characters) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  const std::string screen = shown({"render", scene_}, 80, 24, {{"TERM", "dumb"}});
  EXPECT_TRUE(std::all_of(screen.begin(), screen.end(), [](char c) {
    return (c >= ' ' && c <= '~') || c == '\r' || c == '\n';
  })) << screen;
  EXPECT_EQ(picture_rows(screen), std::vector<int>(6, 16));
}

TEST_F(Terminal, dumb_one_gets_no_control_sequences) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << no_terminal;
  PseudoTerminal terminal(
      client_command({"scenes"}, "", {{"RAYTRACER_SERVER", server().url()}, {"TERM", "dumb"}}), 80,
      24);
  EXPECT_EQ(terminal.wait(10s), 0);
  EXPECT_EQ(terminal.screen().find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace raytracer::test

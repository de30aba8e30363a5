// raytracer tradeoff: the curve as a drawing, as JSON, as a table, or as text.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "tests/cli/client.h"
#include "tests/process/patience.h"
#include "tests/process/pseudo_terminal.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const std::string lit_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 12, "height": 8},
  "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]
})";

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

class TradeoffCommand : public Client {
 protected:
  /// Measures the lit scene into `name` and returns the file's bytes.
  std::string measured(const std::string& name) {
    const Outcome outcome = run_with_server({"tradeoff", "-", "-o", folder_ / name}, lit_scene);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(count_lines(outcome.err), 1) << outcome.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
    return read_file(folder_ / name);
  }
  const TemporaryFolder folder_;
};

TEST_F(TradeoffCommand, json_is_the_servers) {
  const auto curve = nlohmann::json::parse(measured("curve.json"));
  EXPECT_GT(curve.at("reference").at("samples"), 40);
  EXPECT_GE(curve.at("points").size(), 5U);
  EXPECT_GE(curve.at("contract").size(), 3U);
}

TEST_F(TradeoffCommand, csv_has_a_line_for_each_point) {
  std::istringstream lines(measured("CURVE.CSV"));
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("samples,target_rmse,precision,")) << line;
  const int commas = count(line, ",");
  int points = 0;
  bool has_target = false;
  for (; std::getline(lines, line); ++points) {
    EXPECT_EQ(count(line, ","), commas) << line;
    has_target = has_target || line.starts_with(",0.03,");
  }
  EXPECT_GE(points, 5);
  EXPECT_TRUE(has_target);
}

TEST_F(TradeoffCommand, svg_draws_every_point_and_needs_nothing_else) {
  const std::string svg = measured("curve.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\"")) << svg.substr(0, 100);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  for (const char* const part :
       {"prefers-color-scheme: dark", "milliseconds", "root mean square", "class=\"front\" d=\"M",
        "standard input", "1 sample, single", "no shadows", "target 0.01"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  for (const char* const part : {"<script", "<image", "@import", "@font-face", "url(", "href"})
    EXPECT_EQ(svg.find(part), std::string::npos) << part;
  // Four marks are the legend's; every other one says in its title what it stands for.
  EXPECT_EQ(count(svg, "class=\"point ") - 4, count(svg, "<title>") - 1);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST_F(TradeoffCommand, names_are_no_markup) {
  const std::string scene = folder_.write("a<b>&c.json", lit_scene);
  const Outcome outcome = run_with_server({"tradeoff", scene, "-o", folder_ / "curve.svg"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string svg = read_file(folder_ / "curve.svg");
  EXPECT_NE(svg.find("a&lt;b&gt;&amp;c.json"), std::string::npos);
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
}

TEST_F(TradeoffCommand, without_a_file_it_is_text) {
  const Outcome outcome = run_with_server({"tradeoff", "-", "--width", "9"}, lit_scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* const part :
       {"standard input: 9 x 8 pixels", "trace, ms", "1 sample, double", "target 0.03",
        "1 sample, no shadows", "The cheapest for an error of at most", "  0.03 "})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " is not in\n" << outcome.out;
  EXPECT_TRUE(std::regex_search(outcome.out, std::regex(R"(ms  --(samples|target-rmse) )")));
  EXPECT_FALSE(std::regex_search(outcome.out, std::regex(R"(\n[*~ ] +0\.0+ | 0\.0+ ms)")))
      << "a time that says nothing in\n"
      << outcome.out;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST_F(TradeoffCommand, picture_without_an_error_is_drawn_too) {
  const std::string plain = R"({"camera": {"origin": [0,0,0], "look_at": [0,0,1], "fov": 1,
                                           "width": 3, "height": 2}})";
  const Outcome outcome = run_with_server({"tradeoff", "-", "-o", folder_ / "curve.svg"}, plain);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string svg = read_file(folder_ / "curve.svg");
  EXPECT_NE(svg.find("class=\"point "), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST_F(TradeoffCommand, other_endings_are_refused_by_name) {
  for (const std::string name : {"curve.png", "curve"}) {
    const Outcome outcome = run_with_server({"tradeoff", "-", "-o", folder_ / name}, lit_scene);
    expect_input_error(outcome, ".svg, .json, .csv");
    EXPECT_FALSE(fs::exists(folder_ / name));
  }
  expect_input_error(
      run_with_server({"tradeoff", "-", "-o", folder_ / "none/curve.svg"}, lit_scene),
      "none/curve.svg");
}

TEST_F(TradeoffCommand, wrong_scenes_and_arguments_are_refused) {
  const std::string file = folder_.write("wrong.json", wrong_scene);
  expect_input_error(run_with_server({"tradeoff", file}), file + ":3:");
  expect_input_error(run_with_server({"tradeoff"}), "SCENE");
  expect_input_error(run_with_server({"tradeoff", "demo", "--samples", "4"}), "--samples");
  const ServerProcess small({"--max-work", "1000"});
  expect_input_error(run_client({"tradeoff", "-", "--server", small.url()}, lit_scene),
                     "--max-work");
}

TEST_F(TradeoffCommand, interruption_takes_the_job_back_and_leaves_no_file) {
  const ServerProcess server;
  Process client(client_command(
      {"tradeoff", "-", "-o", folder_ / "curve.svg", "--server", server.url()}, endless_scene()));
  ASSERT_TRUE(eventually([&] { return server.log().find("GET /jobs/") != std::string::npos; }));
  client.signal(SIGINT);
  EXPECT_EQ(client.wait(5s), 128 + SIGINT);
  EXPECT_TRUE(eventually([&] { return server.log().find("DELETE /jobs/") != std::string::npos; }))
      << server.log();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 0);
}

TEST_F(TradeoffCommand, terminal_shows_a_bar) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << "there is no terminal: mount /dev/pts";
  PseudoTerminal terminal(client_command({"tradeoff", folder_.write("long.json", endless_scene()),
                                          "--server", server().url()}),
                          80, 24);
  EXPECT_TRUE(terminal.shows("measuring [", 10s)) << terminal.screen();
  terminal.type("\x03");
  EXPECT_EQ(terminal.wait(5s), 128 + SIGINT);
}

TEST(TradeoffAlone, needs_no_server) {
  const Outcome outcome = run_client({"tradeoff", "-"}, lit_scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("rmse"), std::string::npos) << outcome.out;
}

TEST(TradeoffAlone, unreachable_server_is_status_2) {
  const Outcome outcome =
      run_client({"tradeoff", "-", "--server", "http://127.0.0.1:1"}, lit_scene);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
}

}  // namespace
}  // namespace raytracer::test

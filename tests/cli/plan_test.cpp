// raytracer plan: the plan as text for people, or as the server's JSON.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/cli/client.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

class PlanCommand : public Client {};

TEST_F(PlanCommand, says_each_choice_with_its_reason) {
  const Outcome outcome = run_with_server({"plan", "-"}, small_scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* const part : {"objects", "1 sphere", "precision", "geometry", "screen bins",
                                 "sampling", "predicted time", "ms to trace", "predicted error"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " is not in\n" << outcome.out;
}

TEST_F(PlanCommand, lines_fit_a_terminal) {
  std::istringstream lines(run_with_server({"plan", "demo"}).out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_GT(count, 15);
}

TEST_F(PlanCommand, options_stand_over_the_scene) {
  const Outcome outcome =
      run_with_server({"plan", "demo", "--samples", "7", "--precision", "double"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("7 samples per pixel are asked for"), std::string::npos)
      << outcome.out;
}

TEST_F(PlanCommand, gives_the_servers_json) {
  const Outcome outcome = run_with_server({"plan", "demo", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, 2), "{\n");
  EXPECT_NE(outcome.out.find("\"trace_ms\""), std::string::npos) << outcome.out;
}

TEST_F(PlanCommand, wrong_scene_is_refused_line_by_line) {
  const TemporaryFolder folder;
  const std::string file = folder.write("wrong.json", wrong_scene);
  const Outcome outcome = run_with_server({"plan", file});
  expect_input_error(outcome, file + ":3:");
  EXPECT_EQ(count_lines(outcome.err), 3) << outcome.err;
  expect_input_error(run_with_server({"plan", "dmo"}), "demo");
}

TEST(PlanAlone, needs_no_server) {
  const Outcome outcome = run_client({"plan", "first-sphere"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("predicted time"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace raytracer::test

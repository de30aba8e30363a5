// What is wrong with a scene: each error on a line of its own, with its place and JSON Pointer.
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/client.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

class Validate : public Client {
 protected:
  const TemporaryFolder folder_;
};

TEST_F(Validate, valid_scene_is_said_to_be) {
  const Outcome outcome = run_with_server({"validate", "-"}, small_scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "standard input: valid\n");
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(run_with_server({"validate", "demo"}).out, "demo: valid\n");
}

TEST_F(Validate, all_frames_of_a_file_are_checked) {
  const std::string one = "1\n\nC 0 0 0\n";
  const std::string file = folder_.write("atoms.xyz", one + one);
  EXPECT_EQ(run_with_server({"validate", file}).out, file + ": valid, 2 frames\n");
  folder_.write("atoms.xyz", one);
  EXPECT_EQ(run_with_server({"validate", file}).out, file + ": valid\n");
  folder_.write("atoms.xyz", one + "1\n\nC 0 zero 0\n");
  expect_input_error(run_with_server({"validate", file}), file + ":6:");
}

TEST_F(Validate, renders_nothing) {
  EXPECT_EQ(run_with_server({"validate", "-"}, endless_scene()).status, 0);
}

TEST_F(Validate, scene_with_a_budget_whose_picture_has_no_tag_is_valid_too) {
  std::string scene = small_scene;
  scene.insert(scene.rfind('}'), R"(, "render": {"budget_ms": 5})");
  EXPECT_EQ(run_with_server({"validate", "-"}, scene).out, "standard input: valid\n");
}

TEST_F(Validate, each_error_is_a_line_with_place_and_pointer) {
  const std::string file = folder_.write("wrong.json", wrong_scene);
  for (const char* const command : {"validate", "render"}) {
    const Outcome outcome = run_with_server({command, file});
    expect_input_error(outcome, file + ":3:");
    EXPECT_EQ(count_lines(outcome.err), 3) << outcome.err;
    for (const std::string& part :
         {file + ":3:", std::string(": /backgruond: "), std::string("\"background\""),
          file + ":4:", std::string(": /objects/0/radius: "),
          file + ":5:", std::string(": /objects/1/material: ")})
      EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " is not in\n" << outcome.err;
  }
}

TEST_F(Validate, key_that_stands_twice_is_said_with_the_line_of_the_latter) {
  expect_input_error(
      run_with_server({"validate", "-"}, "{\n\"ambient\": 0.1,\n\"ambient\": 0.2\n}"),
      "standard input:3: /ambient: ");
}

TEST_F(Validate, key_that_would_move_the_cursor_stays_in_its_line) {
  const Outcome outcome = run_with_server({"validate", "-"}, R"({"a\n\u001b[2Jb": 1})");
  expect_input_error(outcome, R"(/a\u000a\u001b[2Jb)");
  EXPECT_EQ(outcome.err.find('\033'), std::string::npos) << outcome.err;
}

TEST_F(Validate, text_that_is_not_json_is_said_with_its_line) {
  const Outcome outcome = run_with_server({"validate", "-"}, "{\n  \"camera\": ,\n}");
  expect_input_error(outcome, "line 2");
  EXPECT_EQ(count_lines(outcome.err), 1) << outcome.err;
  expect_input_error(outcome, "standard input:2: not JSON");
  expect_input_error(run_with_server({"validate", "-"}, ""), "line 1");
}

TEST_F(Validate, option_that_is_wrong_is_named) {
  const Outcome outcome =
      run_with_server({"render", "-", "--width", "99999", "--height", "99999"}, small_scene);
  expect_input_error(outcome, "--max-pixels");
}

}  // namespace
}  // namespace raytracer::test

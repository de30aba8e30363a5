// SCENE: a file, standard input, or the name of a shipped scene.
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/client.h"
#include "tests/golden/picture.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

class SceneSource : public Client {
 protected:
  const TemporaryFolder folder_;
};

TEST_F(SceneSource, file_and_standard_input_give_the_same_picture) {
  const Outcome from_file = run_with_server({"render", folder_.write("scene.json", small_scene)});
  const Outcome from_input = run_with_server({"render", "-"}, small_scene);
  EXPECT_EQ(from_file.status, 0) << from_file.err;
  EXPECT_EQ(from_file.out, from_input.out);
  EXPECT_EQ(decode_png(from_file.out).width, 16);
}

TEST_F(SceneSource, file_needs_no_ending) {
  const Outcome outcome = run_with_server({"render", folder_.write("scene", small_scene)});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(SceneSource, file_of_no_known_kind_is_told_what_is_read) {
  const std::string path = folder_.write("positions.vasp", "Al\n1.0\n");
  const std::vector<std::string> commands{"render", "convert"};
  for (const std::string& command : commands)
    expect_input_error(run_client({command, path}), "its ending is none of .nff, .pdb");
}

TEST_F(SceneSource, standard_input_of_another_format_is_told_to_be_a_file) {
  expect_input_error(run_client({"render", "-"}, "ATOM      1  N   MET A   1"), "name a file");
}

TEST_F(SceneSource, shipped_scene_is_found_by_name) {
  const Outcome outcome = run_with_server(
      {"render", "first-sphere", "--width", "30", "--height", "20", "--samples", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(decode_png(outcome.out).width, 30);
}

TEST_F(SceneSource, unknown_name_is_answered_with_the_known_ones) {
  const Outcome outcome = run_with_server({"render", "no-such-scene"});
  expect_input_error(outcome, "no-such-scene");
  EXPECT_NE(outcome.err.find("first-sphere"), std::string::npos) << outcome.err;
}

TEST_F(SceneSource, missing_file_is_said_with_its_path) {
  expect_input_error(run_with_server({"render", "nowhere/scene.json"}), "nowhere/scene.json");
  expect_input_error(run_with_server({"validate", "scene-that-is-not-there.json"}),
                     "scene-that-is-not-there.json");
  expect_input_error(run_with_server({"render", folder_.path()}), folder_.path());
}

TEST_F(SceneSource, scenes_are_listed_with_a_line_each) {
  const Outcome outcome = run_with_server({"scenes"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_GE(count_lines(outcome.out), 6);
  EXPECT_EQ(outcome.out.rfind("demo ", 0), 0U) << outcome.out;
}

}  // namespace
}  // namespace raytracer::test

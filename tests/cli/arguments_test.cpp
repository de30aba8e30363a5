// The command line: what is understood, and that everything else ends with status 1 and a reason.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/client.h"
#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

TEST(Arguments, help_names_commands_and_exit_statuses) {
  for (const char* const flag : {"--help", "-h"}) {
    const Outcome help = run_client({flag});
    EXPECT_EQ(help.status, 0);
    for (const char* const word :
         {"render", "tradeoff", "validate", "scenes", "--server", "RAYTRACER_SERVER"})
      EXPECT_NE(help.out.find(word), std::string::npos) << word;
    EXPECT_EQ(help.err, "");
  }
}

TEST(Arguments, help_of_render_names_every_option) {
  const Outcome help = run_client({"render", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* const option : {"--output", "--samples", "--target-rmse", "--budget-ms",
                                   "--width", "--height", "--precision"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
}

TEST(Arguments, message_that_nobody_can_read_is_no_failure) {
  const auto status_of = [](const std::string& redirected, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"-c", "exec \"$0\" \"$@\" " + redirected, RAYTRACER_CLIENT_PATH});
    return Process({"/bin/sh", std::move(arguments), ""}).wait(std::chrono::seconds(20));
  };
  const TemporaryFolder folder;
  const std::string picture = folder / "picture.png";
  EXPECT_EQ(
      status_of("2>&-", {"render", "glass", "--width", "16", "--height", "12", "-o", picture}), 0);
  EXPECT_EQ(read_file(picture).substr(1, 3), "PNG");
  EXPECT_EQ(status_of("2>&-", {"render", "no such scene"}), 1);
  EXPECT_EQ(status_of(">&-", {"scenes"}), 1);
}

TEST(Arguments, wrong_ones_end_with_status_1_and_say_why) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> table{
      {{}, "command"},
      {{"draw", "demo"}, "draw"},
      {{"render"}, "SCENE"},
      {{"validate"}, "SCENE"},
      {{"render", "demo", "other"}, "other"},
      {{"convert"}, "FILE"},
      {{"convert", "scene.json"}, "there is no such file"},
      {{"convert", "file.nff", "-o", "scene.png"}, ".json"},
      {{"scenes", "demo"}, "demo"},
      {{"render", "demo", "--colour"}, "'--colour' is no command and no option here"},
      {{"render", "demo", "--colour"}, "see raytracer render --help"},
      {{"render", "demo", "--precision", "half"}, "see raytracer render --help"},
      {{"--colour"}, "see raytracer --help"},
      {{"render", "demo", "--samples"}, "--samples: its value is missing"},
      {{"render", "demo", "--samples", "0"}, "--samples"},
      {{"render", "demo", "--samples", "-3"}, "--samples"},
      {{"render", "demo", "--samples", "1.5"}, "--samples"},
      {{"render", "demo", "--samples", "many"}, "--samples"},
      {{"render", "demo", "--target-rmse", "0"}, "--target-rmse"},
      {{"render", "demo", "--target-rmse", "nan"}, "--target-rmse"},
      {{"render", "demo", "--budget-ms", "-1"}, "--budget-ms"},
      {{"render", "demo", "--budget-ms", "soon"}, "--budget-ms"},
      {{"render", "demo", "--width", "0"}, "--width"},
      {{"render", "demo", "--height", "1e3"}, "--height"},
      {{"render", "demo", "--precision", "half"}, "--precision: 'half' is none of auto, single"},
      {{"animate", "demo", "--turntable", "x"}, "--turntable: 'x' is not a whole number"},
      {{"animate", "demo", "--frames", "3"}, "--frames: '3' is not all"},
      {{"render", "demo", "--samples", "2", "--target-rmse", "0.1"}, "--target-rmse"},
      {{"render", "demo", "--samples", "2", "--budget-ms", "10"}, "--budget-ms"},
      {{"render", "demo", "-o", "image.jpg"}, ".png"},
      {{"render", "demo", "-o", "image"}, ".png"},
      {{"render", "demo", "-o"}, "-o"},
      {{"scenes", "--server", "localhost:8080"}, "http://"},
      {{"scenes", "--server", ""}, "--server"},
      {{"scenes", "--server", "http://host:99999"}, "--server"},
      {{"scenes", "--server", "http://host/path"}, "--server"},
      {{"scenes", "--token", "two words"}, "--token"},
  };
  for (const auto& [arguments, says] : table) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_input_error(run_client(arguments), says);
  }
}

TEST(Arguments, wrong_variable_is_named) {
  expect_input_error(run_client({"scenes"}, "", {{"RAYTRACER_SERVER", "nonsense"}}),
                     "RAYTRACER_SERVER");
}

}  // namespace
}  // namespace raytracer::test

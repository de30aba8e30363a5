// Files of other formats: they stand wherever a scene may, and `convert` shows what they become.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/client.h"
#include "tests/golden/picture.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

const std::string nff_ball =
    "v\nfrom 0 -5 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 16 12\n"
    "b 0 0 1\nl 1 2 3\nf 1 0 0 1 0 1 0 0\ns 0 0 0 1\n";
/// On the lines 2 and 3.
const std::string wrong_nff = "b 0 0 0\nb 0 0 2\ns 1 2 3\nv from 0 0 0";

class Convert : public Client {
 protected:
  const TemporaryFolder folder_;
};

TEST_F(Convert, writes_the_document_to_standard_output_or_a_file) {
  const std::string file = folder_.write("ball.NFF", nff_ball);
  const Outcome shown = run_client({"convert", file});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_EQ(nlohmann::json::parse(shown.out).at("objects")[0].at("type"), "sphere");
  const std::string target = folder_ / "ball.json";
  const Outcome written = run_client({"convert", file, "-o", target});
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(read_file(target), shown.out);
}

TEST_F(Convert, says_what_is_left_out_with_a_line_for_each_kind) {
  const std::string file =
      folder_.write("ball.nff", nff_ball + "s 3 0 0 -1\ns 4 0 0 -1\ns 5 0 0 -1\n");
  const Outcome outcome = run_client({"convert", file});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err,
            file + ":1: 1 hither plane left out\n" + file +
                ":12: 3 spheres that are seen from inside only, seen from both sides\n");
}

TEST_F(Convert, each_error_is_a_line_with_its_place) {
  const std::string file = folder_.write("wrong.nff", wrong_nff);
  for (const char* const command : {"convert", "validate", "render", "plan", "tradeoff"}) {
    const Outcome outcome = run_with_server({command, file});
    expect_input_error(outcome, file + ":2: the background has 2");
    EXPECT_NE(outcome.err.find(file + ":4: 'v' stands"), std::string::npos) << outcome.err;
    EXPECT_EQ(count_lines(outcome.err), 3) << outcome.err;
  }
}

TEST_F(Convert, scene_document_stays_as_it_is) {
  const std::string file = folder_.write("scene.json", small_scene);
  EXPECT_EQ(run_client({"convert", file}).out, small_scene);
  EXPECT_EQ(run_client({"convert", "-"}, small_scene).out, small_scene);
  const std::string target = folder_ / "same.json";
  EXPECT_EQ(run_client({"convert", file, "-o", target}).status, 0);
  EXPECT_EQ(read_file(target), small_scene);
  // Without a server nobody says what is wrong with it.
  EXPECT_EQ(run_client({"convert", "-"}, wrong_scene).out, wrong_scene);
}

TEST_F(Convert, shipped_scene_is_fetched) {
  const Outcome outcome = run_with_server({"convert", "demo"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, server().client().Get("/scenes/demo")->body);
  expect_input_error(run_with_server({"convert", "no-such-scene"}), "first-sphere");
}

TEST_F(Convert, text_that_is_not_json_is_said_with_its_place) {
  const std::string file = folder_.write("wrong.json", "{\n  \"camera\": ,\n}");
  const Outcome outcome = run_client({"convert", file});
  expect_input_error(outcome, file + ": parse error at line 2, column 13");
  EXPECT_EQ(count_lines(outcome.err), 1) << outcome.err;
}

TEST_F(Convert, number_that_is_too_large_is_an_error_of_the_scene) {
  const Outcome outcome = run_client({"convert", folder_.write("scene.json", R"({"a": 1e999})")});
  expect_input_error(outcome, "scene.json: number overflow");
}

TEST_F(Convert, needs_no_server_whatever_the_variables_say) {
  const std::string file = folder_.write("ball.nff", nff_ball);
  for (const char* const name : {"RAYTRACER_SERVER", "RAYTRACER_TOKEN"}) {
    const std::map<std::string, std::string> environment{{name, "no such thing"}};
    EXPECT_EQ(run_client({"convert", file}, "", environment).status, 0) << name;
    expect_input_error(run_client({"scenes"}, "", environment), name);
  }
}

TEST_F(Convert, file_that_is_not_there_is_named) {
  for (const char* const command : {"convert", "validate", "render"})
    expect_input_error(run_with_server({command, "nowhere.nff"}), "nowhere.nff: there is no");
}

TEST_F(Convert, file_and_its_document_mean_the_same_picture) {
  const std::string file = folder_.write("ball.nff", nff_ball);
  const std::string document = folder_ / "ball.json";
  ASSERT_EQ(run_client({"convert", file, "-o", document}).status, 0);
  const Outcome checked = run_with_server({"validate", document});
  EXPECT_EQ(checked.out, document + ": valid\n") << checked.err;
  EXPECT_EQ(run_with_server({"validate", file}).out, file + ": valid\n");
  const Outcome picture = run_with_server({"render", file});
  EXPECT_EQ(picture.status, 0) << picture.err;
  EXPECT_EQ(decode_png(picture.out).width, 16);
  EXPECT_EQ(picture.out, run_with_server({"render", document}).out);
  for (const char* const command : {"plan", "tradeoff"})
    EXPECT_EQ(run_with_server({command, file}).status, 0) << command;
}

}  // namespace
}  // namespace raytracer::test

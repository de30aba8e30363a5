// Where the picture goes: a file of the format that its ending names, or standard output.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "tests/cli/client.h"
#include "tests/golden/picture.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;

class Delivery : public Client {
 protected:
  /// Renders the small scene into `name` and returns the file's bytes.
  std::string render_to(const std::string& name, std::vector<std::string> options = {}) {
    std::vector<std::string> arguments{"render", "-", "-o", folder_ / name};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_with_server(arguments, small_scene);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    return read_file(folder_ / name);
  }
  const TemporaryFolder folder_;
};

TEST_F(Delivery, ending_chooses_the_format) {
  const Picture png = decode_png(render_to("image.png"));
  EXPECT_EQ(png.width, 16);
  EXPECT_EQ(png.height, 12);
  EXPECT_EQ(decode_ppm(render_to("image.ppm")), png);
  EXPECT_EQ(decode_pfm(render_to("image.pfm")), png);
  EXPECT_EQ(decode_png(render_to("IMAGE.PNG")), png);
}

TEST_F(Delivery, transparent_background_is_in_a_png_and_no_other_file) {
  const auto render = [&](const std::string& name) {
    return run_with_server({"render", "-", "-o", folder_ / name}, transparent_scene);
  };
  const Outcome outcome = render("image.png");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(decode_covered_png(read_file(folder_ / "image.png")).rgba[3], 0);
  for (const char* const name : {"image.ppm", "image.pfm"}) {
    const Outcome refused = render(name);
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("transparent background"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("image/png"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(folder_ / name));
  }
}

TEST_F(Delivery, options_stand_over_the_document) {
  const Picture picture = decode_png(render_to("image.png", {"--width", "20", "--height", "10"}));
  EXPECT_EQ(picture.width, 20);
  EXPECT_EQ(picture.height, 10);
  EXPECT_NE(render_to("4.png", {"--samples", "4"}), render_to("1.png", {"--samples", "1"}));
  render_to("target.png", {"--target-rmse", "0.3"});
  render_to("budget.png", {"--budget-ms", "50"});
  render_to("both.png", {"--target-rmse", "1e-9", "--budget-ms", "50"});
  render_to("double.png", {"--precision", "double"});
}

TEST_F(Delivery, one_line_says_what_came_of_it) {
  const std::string path = folder_ / "image.png";
  const Outcome outcome =
      run_with_server({"render", "-", "-o", path, "--samples", "3"}, small_scene);
  EXPECT_EQ(count_lines(outcome.err), 1) << outcome.err;
  for (const std::string& part : {path, std::string("16 x 12"), std::string("3 samples"),
                                  std::string("trace "), std::string(" ms")})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

TEST_F(Delivery, without_a_file_and_a_terminal_it_goes_to_standard_output) {
  const Outcome outcome = run_with_server({"render", "-"}, small_scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, render_to("image.png"));
}

TEST_F(Delivery, existing_file_is_replaced) {
  folder_.write("image.png", "old");
  EXPECT_EQ(decode_png(render_to("image.png")).width, 16);
}

TEST_F(Delivery, wrong_scene_leaves_the_old_file) {
  folder_.write("image.png", "old");
  const Outcome outcome = run_with_server({"render", "-", "-o", folder_ / "image.png"}, "{}");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(read_file(folder_ / "image.png"), "old");
}

TEST_F(Delivery, nothing_but_the_image_is_left_behind) {
  render_to("image.png");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(Delivery, folder_that_is_missing_is_said_before_rendering) {
  const Outcome outcome = run_client({"render", "-", "-o", folder_ / "none/image.png"},
                                     endless_scene(), {{"RAYTRACER_SERVER", server().url()}});
  expect_input_error(outcome, "none/image.png");
}

TEST_F(Delivery, folder_in_the_files_place_is_refused) {
  fs::create_directory(folder_ / "image.png");
  expect_input_error(run_with_server({"render", "-", "-o", folder_ / "image.png"}, small_scene),
                     "image.png");
}

TEST_F(Delivery, full_device_is_an_error) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const Outcome outcome = run({"/bin/sh",
                               {"-c", std::string(RAYTRACER_CLIENT_PATH) + " scenes > /dev/full"},
                               "",
                               {{"RAYTRACER_SERVER", server().url()}}});
  expect_input_error(outcome, "standard output");
}

TEST_F(Delivery, reader_that_leaves_is_an_error_not_a_crash) {
  // An echo to the pipe fails once its reader has gone, so that is before the picture is written.
  const std::string script = std::string("(while (echo); do sleep 0.01; done; ") +
                             RAYTRACER_CLIENT_PATH +
                             " render -; echo status $? >&2) < scene.json | true";
  folder_.write("scene.json", small_scene);
  Command command{"/bin/sh", {"-c", script}, "", {{"RAYTRACER_SERVER", server().url()}}};
  command.directory = folder_.path();
  const Outcome outcome = run(command);
  EXPECT_NE(outcome.err.find("status 1\n"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace raytracer::test

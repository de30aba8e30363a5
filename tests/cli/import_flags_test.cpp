// The flags about files that leave open how they are to look.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/client.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

class ImportFlags : public Client {
 protected:
  json convert(std::vector<std::string> options) const {
    options.insert(options.begin(), {"convert", file_});
    const Outcome outcome = run_client(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out);
  }

  const TemporaryFolder folder_;
  const std::string file_ = folder_.write(
      "a.extxyz", "2\nProperties=species:S:1:pos:R:3:mass:R:1\nC 0 0 0 12\nO 1.2 0 0 16\n");
};

TEST_F(ImportFlags, style_and_colour_change_the_document) {
  EXPECT_EQ(convert({}).at("objects").size(), 2U);
  EXPECT_EQ(convert({"--style", "ball-and-stick"}).at("objects").size(), 4U);
  EXPECT_TRUE(convert({}).at("materials").contains("C"));
  const json magma = convert({"--color", "mass", "--colormap", "magma"}).at("materials");
  EXPECT_NE(magma, convert({"--color", "mass"}).at("materials"));
}

TEST_F(ImportFlags, camera_and_background_are_as_asked) {
  const json camera = convert({"--view", "0,0,2"}).at("camera");
  EXPECT_GT(camera.at("origin")[2].get<double>(), camera.at("look_at")[2].get<double>());
  EXPECT_LT(convert({"--zoom", "3"}).at("camera").at("fov"), convert({}).at("camera").at("fov"));
  EXPECT_EQ(convert({"--background", "transparent"}).at("background"), "transparent");
  EXPECT_EQ(convert({"--background", "#000000"}).at("background"), json({0, 0, 0}));
}

TEST_F(ImportFlags, that_are_none_are_refused) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& says) {
    std::vector<std::string> arguments{"convert", file_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_input_error(run_client(arguments), says);
  };
  refused({"--style", "balls"}, "--style");
  refused({"--colormap", "jet"}, "--colormap");
  refused({"--view", "0,0,0"}, "'0,0,0' is no direction; write x,y,z");
  refused({"--view", "1,2"}, "'1,2' is no direction");
  refused({"--zoom", "0"}, "--zoom");
  refused({"--background", "white"}, "'white' is no colour; write #rrggbb or transparent");
  refused({"--color", "charge"}, file_ + ":2: nothing here is called 'charge'");
}

TEST_F(ImportFlags, scene_that_says_everything_takes_none) {
  const std::string scene = folder_.write("scene.json", small_scene);
  expect_input_error(run_with_server({"validate", scene, "--view", "1,0,0"}), "--view");
  expect_input_error(run_with_server({"validate", "demo", "--style", "sticks"}), "--style");
  const std::string mesh = folder_.write("a.stl", "solid\nendsolid\n");
  expect_input_error(run_client({"convert", mesh, "--water"}), "--water");
}

TEST_F(ImportFlags, width_and_height_shape_what_the_camera_sees) {
  const std::string wide = folder_ / "wide.ppm";
  ASSERT_EQ(run_with_server({"render", file_, "--view", "0,0,1", "--width", "400", "--height",
                             "100", "-o", wide, "--samples", "1"})
                .status,
            0);
  // The corners show the background, so that nothing is cut off.
  const std::string bytes = read_file(wide);
  for (std::size_t x = 0; x < 400; ++x)
    EXPECT_EQ(bytes[bytes.size() - 3 * (x + 1)], '\xFF') << "last row, from the right " << x;
}

TEST_F(ImportFlags, first_of_several_frames_is_shown_and_said) {
  const std::string file = folder_.write("two.xyz", "1\n\nC 0 0 0\n1\n\nC 0 0 0\n");
  EXPECT_NE(run_client({"convert", file}).err.find("animate --frames all"), std::string::npos);
}

}  // namespace
}  // namespace raytracer::test

// `animate`: a turn round any scene or a file's frames, as numbered pictures, an animated PNG or
// raw video.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/cli/client.h"
#include "tests/golden/picture.h"
#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

const std::string three_frames = "1\n\nC 0 0 0\n1\n\nC 0 1 0\n1\n\nN 0 0 1\n";

class Animate : public Client {
 protected:
  /// With the arguments, in 20 x 10 pixels.
  Outcome animate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "animate");
    for (const char* const argument : {"--width", "20", "--height", "10", "--samples", "1"})
      arguments.emplace_back(argument);
    return run_with_server(arguments);
  }

  /// How often the bytes have these.
  static int count(const std::string& bytes, const std::string& word) {
    int times = 0;
    for (std::size_t at = bytes.find(word); at != bytes.npos; at = bytes.find(word, at + 1))
      ++times;
    return times;
  }

  const TemporaryFolder folder_;
};

TEST_F(Animate, frames_of_a_file_become_numbered_pictures) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  const Outcome outcome = animate({file, "--frames", "all", "-o", folder_ / "f-%03d.png"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* const name : {"f-000.png", "f-001.png", "f-002.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f-003.png"));
  // What a render of the first frame alone gives.
  const std::string alone = folder_ / "alone.png";
  ASSERT_EQ(run_with_server(
                {"render", file, "-o", alone, "--width", "20", "--height", "10", "--samples", "1"})
                .status,
            0);
  EXPECT_EQ(read_file(folder_ / "f-000.png"), read_file(alone));
  EXPECT_NE(read_file(folder_ / "f-001.png"), read_file(alone));
}

TEST_F(Animate, turn_begins_with_the_scene_and_goes_round_it) {
  const std::string scene = folder_.write("scene.json", R"({
    "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 20, "height": 10},
    "ambient": 1, "shadows": "ambient",
    "objects": [{"type": "sphere", "center": [1, 0, 0], "radius": 0.5}]})");
  ASSERT_EQ(animate({scene, "--turntable", "4", "-o", folder_ / "t-%d.ppm"}).status, 0);
  const std::string first = read_file(folder_ / "t-0.ppm");
  ASSERT_EQ(run_with_server({"render", scene, "-o", folder_ / "a.ppm", "--samples", "1"}).status,
            0);
  EXPECT_EQ(first, read_file(folder_ / "a.ppm"));
  EXPECT_NE(first, read_file(folder_ / "t-1.ppm"));
  // From behind the sphere is on the other side.
  const std::string behind = read_file(folder_ / "t-2.ppm");
  const std::size_t header = first.size() - 3 * 20 * 10;
  const auto pixel = [&](const std::string& ppm, std::size_t x) {
    return static_cast<unsigned char>(ppm[header + 3 * (5 * 20 + x)]);
  };
  for (std::size_t x = 0; x < 20; ++x) EXPECT_EQ(pixel(first, x), pixel(behind, 19 - x)) << x;
}

TEST_F(Animate, animated_png_has_all_frames_and_plays_for_ever) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  const std::string target = folder_ / "motion.apng";
  ASSERT_EQ(animate({file, "--frames", "all", "-o", target, "--fps", "12.5"}).status, 0);
  const std::string bytes = read_file(target);
  EXPECT_EQ(count(bytes, "fcTL"), 3);
  EXPECT_EQ(count(bytes, "fdAT"), 2);
  const std::string control("acTL\0\0\0\3\0\0\0\0", 12);
  EXPECT_NE(bytes.find(control), std::string::npos);
  const std::string delay("\0\2\0\x19\0\0", 6);  // 2/25 s
  EXPECT_EQ(count(bytes, delay), 3);
}

/// APNG has sixteen bits for each half of the delay's fraction: 1000/100001 s is not one of them.
TEST_F(Animate, animated_png_has_the_nearest_rate_that_it_can_say) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  const std::string target = folder_ / "motion.apng";
  const auto delays = [&](const std::string& rate, const std::string& delay) {
    EXPECT_EQ(animate({file, "--frames", "all", "-o", target, "--fps", rate}).status, 0);
    return count(read_file(target), delay);
  };
  EXPECT_EQ(delays("100.001", std::string("\x02\x8F\xFF\xDD\0\0", 6)), 3);  // 655/65501
  EXPECT_EQ(delays("29.97", std::string("\0\x64\x0B\xB5\0\0", 6)), 3);      // 100/2997
  EXPECT_EQ(delays("999.999", std::string("\0\x01\x03\xE8\0\0", 6)), 3);    // 1/1000
  EXPECT_EQ(delays("0.001", std::string("\x03\xE8\0\x01\0\0", 6)), 3);      // 1000/1
}

TEST_F(Animate, raw_video_is_a_header_and_planes) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  const Outcome outcome = animate({file, "--frames", "all", "-o", "-"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(animate({file, "--frames", "all", "--format", "y4m"}).out, outcome.out);
  const std::string header = "YUV4MPEG2 W20 H10 F25:1 Ip A1:1 C420jpeg\n";
  ASSERT_TRUE(outcome.out.starts_with(header));
  const std::size_t frame = std::string("FRAME\n").size() + 200 + 50 + 50;
  EXPECT_EQ(outcome.out.size(), header.size() + 3 * frame);
  // The corner is white: 235 in the range of video, without colour.
  const std::size_t first = header.size() + 6;
  EXPECT_EQ(static_cast<unsigned char>(outcome.out[first]), 235);
  EXPECT_EQ(static_cast<unsigned char>(outcome.out[first + 200]), 128);
  EXPECT_EQ(static_cast<unsigned char>(outcome.out[first + 250]), 128);
}

TEST_F(Animate, what_is_there_is_not_rendered_again) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  const std::string target = folder_ / "f-%d.png";
  ASSERT_EQ(animate({file, "--frames", "all", "-o", target}).status, 0);
  const std::string second = read_file(folder_ / "f-1.png");
  std::filesystem::remove(folder_ / "f-1.png");
  const std::string other = read_file(folder_ / "f-0.png");
  static_cast<void>(folder_.write("f-2.png", other));
  const Outcome again = animate({file, "--frames", "all", "-o", target, "--resume"});
  EXPECT_NE(again.err.find("1 frame written"), std::string::npos) << again.err;
  EXPECT_EQ(read_file(folder_ / "f-1.png"), second);
  EXPECT_EQ(read_file(folder_ / "f-2.png"), other);
}

TEST_F(Animate, what_was_cut_is_rendered_again) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  for (const std::string ending : {".png", ".ppm", ".pfm"}) {
    const std::string target = folder_ / ("f-%d" + ending);
    ASSERT_EQ(animate({file, "--frames", "all", "-o", target}).status, 0);
    const std::string first = read_file(folder_ / ("f-0" + ending));
    static_cast<void>(folder_.write("f-0" + ending, first.substr(0, first.size() - 1)));
    static_cast<void>(folder_.write("f-1" + ending, ""));
    const Outcome again = animate({file, "--frames", "all", "-o", target, "--resume"});
    EXPECT_NE(again.err.find("2 frames written"), std::string::npos) << again.err;
    EXPECT_EQ(read_file(folder_ / ("f-0" + ending)), first);
  }
}

TEST_F(Animate, frames_of_another_size_are_not_resumed) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  const std::string target = folder_ / "f-%d.png";
  ASSERT_EQ(animate({file, "--frames", "all", "-o", target}).status, 0);
  std::filesystem::remove(folder_ / "f-1.png");
  Command command = client_command({"animate", file, "--frames", "all", "-o", target, "--width",
                                    "30", "--height", "10", "--samples", "1", "--resume"});
  expect_input_error(run(command), "f-2.png has 20 x 10 pixels");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f-1.png"));
}

TEST_F(Animate, animated_png_goes_on_where_it_broke_off) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  ASSERT_EQ(animate({file, "--frames", "all", "-o", folder_ / "f-%d.png"}).status, 0);
  const std::filesystem::path target = folder_ / "m.apng";
  const std::filesystem::path frames = folder_ / "m.apng.frames";
  std::filesystem::create_directory(frames);
  std::filesystem::copy_file(folder_ / "f-0.png", frames / "1.png");  // as nobody would render it
  const Outcome on = animate({file, "--frames", "all", "-o", target, "--resume"});
  ASSERT_EQ(on.status, 0) << on.err;
  EXPECT_FALSE(std::filesystem::exists(frames));
  const std::string film = read_file(target);
  EXPECT_EQ(count(film, "fcTL"), 3);
  const auto pixels = [](const std::string& png) {
    const std::size_t begin = png.find("IDAT") + 4;
    return png.substr(begin, png.find("IEND") - begin - 8);
  };
  EXPECT_EQ(count(film, pixels(read_file(folder_ / "f-0.png"))), 2);
  EXPECT_EQ(count(film, pixels(read_file(folder_ / "f-1.png"))), 0);
  // The last is there, and what an earlier film left is nobody's.
  std::filesystem::create_directory(frames);
  std::filesystem::copy_file(folder_ / "f-2.png", frames / "2.png");
  ASSERT_EQ(animate({file, "--frames", "all", "-o", target, "--resume"}).status, 0);
  EXPECT_EQ(count(read_file(target), "fcTL"), 3);
  std::filesystem::create_directory(frames);
  static_cast<void>(folder_.write("m.apng.frames/7.png", "of another film"));
  ASSERT_EQ(animate({file, "--frames", "all", "-o", target}).status, 0);
  EXPECT_EQ(count(read_file(target), pixels(read_file(folder_ / "f-1.png"))), 1);
  EXPECT_FALSE(std::filesystem::exists(frames));
  std::filesystem::create_directory(frames);
  const std::string last = read_file(folder_ / "f-2.png");
  static_cast<void>(folder_.write("m.apng.frames/2.png", last.substr(0, 40) + last.substr(50)));
  expect_input_error(animate({file, "--frames", "all", "-o", target, "--resume"}),
                     "m.apng.frames: remove the folder");
}

TEST_F(Animate, without_a_name_frames_are_numbered_where_one_is) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  Command command = client_command(
      {"animate", file, "--frames", "all", "--width", "20", "--height", "10", "--samples", "1"});
  command.directory = folder_.path();
  EXPECT_EQ(run(command).status, 0);
  for (const char* const name : {"frame-0000.png", "frame-0002.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
}

TEST_F(Animate, frames_before_an_error_are_a_film) {
  const std::string file = folder_.write("atoms.xyz", "1\n\nC 0 0 0\n1\n\nC 0 zero 0\n");
  const std::string target = folder_ / "m.apng";
  expect_input_error(animate({file, "--frames", "all", "-o", target}), file + ":6: 'zero' stands");
  EXPECT_EQ(count(read_file(target), "fcTL"), 1);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "m.apng.frames/0.png"));  // to go on with
}

TEST_F(Animate, error_of_a_later_frame_is_said_after_the_earlier_ones) {
  const std::string file = folder_.write("atoms.xyz", "1\n\nC 0 0 0\n1\n\nC 0 zero 0\n");
  const Outcome outcome = animate({file, "--frames", "all", "-o", folder_ / "f-%d.png"});
  expect_input_error(outcome, file + ":6: 'zero' stands");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "f-0.png"));
}

TEST_F(Animate, each_error_of_a_scene_is_a_line_with_place_and_pointer) {
  const std::string file = folder_.write("wrong.json", wrong_scene);
  const Outcome outcome = animate({file, "--turntable", "3", "-o", folder_ / "t-%d.png"});
  expect_input_error(outcome, file + ":3: /backgruond: ");
  EXPECT_NE(outcome.err.find(file + ":4: /objects/0/radius: "), std::string::npos) << outcome.err;
  EXPECT_EQ(count_lines(outcome.err), 3) << outcome.err;
  const std::string without_camera = folder_.write("none.json", R"({"objects": []})");
  expect_input_error(animate({without_camera, "--turntable", "3", "-o", folder_ / "t-%d.png"}),
                     "/camera: ");
  const std::string no_json = folder_.write("no.json", "{\n  \"camera\": ,\n}");
  const Outcome unread = animate({no_json, "--turntable", "3", "-o", folder_ / "t-%d.png"});
  expect_input_error(unread, "line 2, column 13");
  EXPECT_EQ(count_lines(unread.err), 1) << unread.err;
}

TEST_F(Animate, arguments_that_do_not_go_together_are_refused) {
  const std::string file = folder_.write("atoms.xyz", three_frames);
  expect_input_error(animate({file, "-o", "a.apng"}), "Give --turntable N or --frames all");
  expect_input_error(animate({file, "--turntable", "3", "-o", "a.png"}), "names no frames");
  expect_input_error(animate({file, "--turntable", "3", "-o", "a.apng", "--format", "y4m"}),
                     "--format y4m is for a pipe");
  expect_input_error(animate({file, "--turntable", "3", "-o", "a-%d.jpg"}), ".png, .ppm or .pfm");
  expect_input_error(animate({file, "--turntable", "3", "-o", "-", "--resume"}), "--resume");
  expect_input_error(animate({file, "--turntable", "3", "-o", "nowhere/a.apng"}), "nowhere");
  expect_input_error(animate({"demo", "--frames", "all", "-o", "a.apng"}), "demo: has no frames");
  expect_input_error(animate({file, "--turntable", "3", "-o", "a.apng", "--fps", "0"}), "--fps");
}

}  // namespace
}  // namespace raytracer::test

// raytracer animate: a turn round a scene, or the frames of a file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/failure.h"
#include "client/film.h"
#include "client/notice.h"
#include "client/shooting.h"
#include "client/turntable.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

struct AnimateArguments {
  SceneChoice scene;
  Overrides overrides;
  int turntable = 0;  ///< frames of a turn; 0: the file's own frames
  std::string frames;
  FilmTarget target;
};

/// With the server that keeps the scene.
NextRequest turn(Api& api, const AnimateArguments& arguments, const SceneText& scene) {
  Overrides query = arguments.overrides;
  query["scene"] = api.keep_scene(scene);  // first: the server says what is wrong with it
  const Orbit orbit = orbit_of(scene);
  return [orbit, query, label = scene.label, count = arguments.turntable,
          frame = 0]() mutable -> std::optional<FrameRequest> {
    if (frame == count) return std::nullopt;
    Overrides with_camera = orbit.at(static_cast<double>(frame++) / count);
    with_camera.insert(query.begin(), query.end());
    return FrameRequest{{label, "", false}, std::move(with_camera)};
  };
}

void animate(AnimateArguments& arguments, const ServerChoice& server) {
  if (arguments.turntable == 0 && arguments.frames.empty())
    throw InputError("animate: what is to move? Give --turntable N or --frames all");
  arguments.scene.import_options.is_turned = arguments.turntable > 0;
  const std::unique_ptr<Film> film = open_film(arguments.target);
  FilmProgress progress(arguments.turntable);
  if (arguments.turntable > 0) {
    with_scene(arguments.scene, arguments.overrides, server, [&](Api& api, const SceneText& scene) {
      shoot(api, turn(api, arguments, scene), *film, progress);
    });
  } else {
    const NextFrame next_frame = read_frames(arguments.scene, arguments.overrides);
    // Read before there is a server: what is wrong with the file is said at once.
    std::optional<SceneText> first = next_frame();
    with_server(server, [&](Api& api) {
      const auto next = [&]() -> std::optional<FrameRequest> {
        std::optional<SceneText> scene = first ? std::exchange(first, std::nullopt) : next_frame();
        if (!scene) return std::nullopt;
        return FrameRequest{*std::move(scene), arguments.overrides};
      };
      shoot(api, next, *film, progress);
    });
  }
  notice(film->finish(/*is_whole=*/true));
}

/// A rate as a ratio of integers: 23.976 is 2997/125.
FrameRate rate_of(double frames_a_second) {
  constexpr int most = 1000;
  if (!(frames_a_second >= 0.001 && frames_a_second <= most))
    throw InputError("--fps: a number from 0.001 to 1000");
  const int thousandths = static_cast<int>(std::lround(frames_a_second * 1000));
  const int common = std::gcd(thousandths, 1000);
  return {thousandths / common, 1000 / common};
}

}  // namespace

void add_animate(CLI::App& app, const ServerChoice& server) {
  const auto arguments = std::make_shared<AnimateArguments>();
  CLI::App& command = add_scene_command(
      app, "animate", "Render a turn round a scene or a file's frames", arguments->scene);
  CLI::Option* const turntable =
      command.add_option("--turntable", arguments->turntable, "A turn round the scene in N frames")
          ->option_text("N")
          ->check(refuse_unless_whole(1, 100'000));
  command.add_option("--frames", arguments->frames, "The file's models or time steps")
      ->option_text("all")
      ->check(refuse_unless_among({"all"}))
      ->excludes(turntable);
  command
      .add_option("-o,--output", arguments->target.output,
                  fmt::format("FRAMES-%04d.png, MOTION.apng, or - for raw video [{}]",
                              FilmTarget::numbered_files))
      ->option_text("FILE");
  command
      .add_option_function<std::string>(
          "--format", [arguments](const std::string&) { arguments->target.is_y4m = true; },
          "Raw video for a pipe: ... -o - | ffmpeg -i - MOTION.mp4")
      ->option_text("y4m")
      ->check(refuse_unless_among({"y4m"}));
  command
      .add_option_function<double>(
          "--fps", [arguments](double rate) { arguments->target.rate = rate_of(rate); },
          "Frames a second of .apng and y4m [25]")
      ->option_text("F");
  command.add_flag("--resume", arguments->target.resumes,
                   "Render only frames that are not there yet");
  add_accuracy_options(command, arguments->overrides);
  add_picture_options(command, arguments->overrides);
  command.callback([arguments, &server] { animate(*arguments, server); });
}

}  // namespace raytracer::client

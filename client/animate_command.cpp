// raytracer animate: a turn round a scene, or the frames of a file, each a job. Several are under
// way at a time, so that the server works while frames are read, fetched and written.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/failure.h"
#include "client/film.h"
#include "client/owned_job.h"
#include "client/progress_bar.h"
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

/// A frame as it is asked for.
struct FrameRequest {
  SceneText scene;  ///< without a text where the query names it
  Overrides query;
};

/// The next frame, or nothing behind the last one.
using NextRequest = std::function<std::optional<FrameRequest>()>;

/// How far an animation has come, with the time that it still takes where that can be known.
class FilmProgress {
 public:
  /// `count`: of frames; 0: not known.
  explicit FilmProgress(int count) : count_(count) {}

  void show(int frame, double of_frame) {
    const double done = count_ > 0 ? (frame - first_ + of_frame) / (count_ - first_) : 0;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    std::string what = count_ > 0 ? fmt::format("frame {} of {}", frame + 1, count_)
                                  : fmt::format("frame {}", frame + 1);
    if (done > 0.02) what += fmt::format(", {:.0f} s left", elapsed.count() * (1 / done - 1));
    bar_.show(what, done);
  }

  /// Frames before this one were there.
  void skip_to(int frame) { first_ = std::min(frame, count_ > 0 ? count_ - 1 : frame); }

 private:
  int count_;
  int first_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  ProgressBar bar_;
};

/// Renders all frames that the film does not have, and adds them in their order.
void shoot(Api& api, const NextRequest& next, Film& film, FilmProgress& progress) {
  constexpr std::size_t most_under_way = 8;  // a private server renders four at a time
  const std::string media_type = film.media_type();
  int added = 0;
  std::deque<std::pair<int, OwnedJob>> under_way;
  const auto take_oldest = [&] {
    auto& [frame, job] = under_way.front();
    const int number = frame;
    job.wait("rendering", [&](const Job& now) { progress.show(number, now.progress); });
    film.add(number, api.job_image(job.id(), media_type).bytes);
    ++added;
    under_way.pop_front();
  };
  const auto start = [&](int frame, const FrameRequest& request) {
    for (;;) {
      try {
        under_way.emplace_back(
            std::piecewise_construct, std::forward_as_tuple(frame),
            std::forward_as_tuple(api, api.start_job(request.scene, request.query, media_type)));
        return;
      } catch (const ServerBusy&) {
        if (under_way.empty()) throw;  // others keep it busy
        take_oldest();
      }
    }
  };
  std::exception_ptr end;  // what is wrong with a frame; those before it are finished
  for (int frame = 0;; ++frame) {
    std::optional<FrameRequest> request;
    try {
      request = next();
    } catch (const InputError&) {
      end = std::current_exception();
    }
    if (!request) break;
    if (film.has(frame)) {
      if (under_way.empty()) progress.skip_to(frame + 1);
      continue;
    }
    while (under_way.size() >= most_under_way) take_oldest();
    start(frame, *request);
  }
  while (!under_way.empty()) take_oldest();
  if (!end) return;
  if (added > 0) fmt::print(stderr, "{}\n", film.finish());
  std::rethrow_exception(end);
}

/// With the server that keeps the scene.
NextRequest turn(Api& api, const AnimateArguments& arguments, const SceneText& scene) {
  const Orbit orbit = orbit_of(scene);
  Overrides query = arguments.overrides;
  query["scene"] = api.keep_scene(scene);
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
  arguments.scene.wishes.is_turned = arguments.turntable > 0;
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
  fmt::print(stderr, "{}\n", film->finish());
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
          ->check(CLI::Range(1, 100'000));
  command.add_option("--frames", arguments->frames, "The file's models or time steps")
      ->option_text("all")
      ->check(CLI::IsMember({"all"}))
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
      ->check(CLI::IsMember({"y4m"}));
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

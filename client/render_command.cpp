// raytracer render: the scene becomes a job, the job an image, the image a file or a picture in
// the terminal. The server is left before anything is written, however long a reader takes.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "client/atomic_file.h"
#include "client/commands.h"
#include "client/progress_bar.h"
#include "client/scene_errors.h"
#include "client/terminal.h"
#include "client/terminal_picture.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

using std::chrono::milliseconds;

/// A job that ends with the client, whichever way.
class OwnedJob {
 public:
  OwnedJob(Api& api, Job job) : api_(api), job_(std::move(job)) {}
  ~OwnedJob() { api_.delete_job(job_.id); }
  OwnedJob(const OwnedJob&) = delete;
  OwnedJob& operator=(const OwnedJob&) = delete;

  /// Returns when the image is complete. Throws ServerError if it will not be.
  void wait() {
    ProgressBar bar;
    milliseconds pause(10);
    for (; job_.status == "queued" || job_.status == "running"; job_ = api_.job(job_.id)) {
      bar.show(job_.status == "queued" ? "queued" : "rendering", job_.progress);
      api_.pause(pause);
      pause = std::min(pause * 3 / 2, milliseconds(200));
    }
    if (job_.status != "done")
      throw ServerError(fmt::format("the render was {}{}{}", job_.status,
                                    job_.detail.empty() ? "" : ": ", job_.detail));
  }

  RenderedImage image(ImageFormat format) { return api_.job_image(job_.id, format); }

 private:
  Api& api_;
  Job job_;
};

/// "queue;dur=0.1, trace;dur=42" as "queue 0.1 ms, trace 42 ms"
std::string stage_times(const std::string& server_timing) {
  std::string times;
  std::istringstream stages(server_timing);
  for (std::string stage; std::getline(stages >> std::ws, stage, ',');) {
    constexpr std::string_view mark = ";dur=";
    const std::size_t at = stage.find(mark);
    if (at == stage.npos) continue;
    times += fmt::format("{}{} {} ms", times.empty() ? "" : ", ", stage.substr(0, at),
                         stage.substr(at + mark.size()));
  }
  return times;
}

/// One line: where it went, what it is, how it was made.
std::string summary(const std::string& place, const RenderedImage& image) {
  std::string line = place;
  if (const auto size = image_size(image.bytes))
    line += fmt::format(": {} x {}", size->width_px, size->height_px);
  const auto add = [&](const char* before, const std::string& value, const char* after) {
    if (!value.empty()) line += fmt::format(", {}{}{}", before, value, after);
  };
  add("", image.samples, " samples per pixel");
  add("", image.precision, " precision");
  add("error ", image.error, "");
  add("ended by ", image.stop, "");
  if (!image.server_timing.empty()) line += "; " + stage_times(image.server_timing);
  return line;
}

void write_to_standard_output(std::string_view bytes) {
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  if (!written || std::fflush(stdout) != 0)
    throw InputError(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

}  // namespace

void render(const RenderArguments& arguments, const ServerChoice& server) {
  const bool in_terminal = !arguments.output && ::isatty(STDOUT_FILENO) == 1;
  if (in_terminal && !takes_control_sequences())
    throw InputError("this terminal shows no colours: name a file for the image with -o");
  if (arguments.output) check_writable(*arguments.output);
  const ImageFormat format = arguments.output ? format_of(*arguments.output).value()
                             : in_terminal    ? ImageFormat::ppm
                                              : ImageFormat::png;
  std::optional<SceneSource> scene = read_scene_file(arguments.scene);

  RenderedImage image;
  with_server(server, [&](Api& api) {
    if (!scene) scene = fetch_shipped_scene(arguments.scene, api);
    try {
      OwnedJob job(api, api.start_render(scene->text, arguments.overrides));
      job.wait();
      image = job.image(format);
    } catch (const Refused& refused) {
      throw explain(refused, *scene, arguments.overrides);
    }
  });

  if (arguments.output) {
    write_atomically(*arguments.output, image.bytes);
  } else if (in_terminal) {
    TerminalSize size = terminal_size(STDOUT_FILENO);
    size.rows -= 3;  // the line about the image, which may wrap, and the prompt
    write_to_standard_output(half_blocks(read_ppm(image.bytes), size));
  } else {
    write_to_standard_output(image.bytes);
  }
  fmt::print(stderr, "{}\n",
             summary(arguments.output ? arguments.output->string() : scene->label, image));
}

}  // namespace raytracer::client

// raytracer render: the scene becomes a job, the job an image, the image a file or a picture in
// the terminal. The server is left before anything is written, however long a reader takes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/delivery.h"
#include "client/failure.h"
#include "client/image_format.h"
#include "client/notice.h"
#include "client/owned_job.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

struct RenderArguments {
  SceneChoice scene;
  std::optional<OutputFile> output;  ///< none: the terminal, or standard output
  Overrides overrides;
  bool watch = false;  ///< again whenever the file changes
};

RenderedImage render_scene(const SceneText& scene, const Overrides& overrides,
                           std::string_view media_type, Api& api) {
  OwnedJob job(api, api.start_job(scene, overrides, media_type));
  job.wait("rendering");
  return api.job_image(job.id(), media_type);
}

/// Waits until the file is another one than that of `seen`. An editor may take it away for a
/// moment.
void wait_for_change(const std::filesystem::path& file, std::filesystem::file_time_type seen,
                     Api& api) {
  constexpr std::chrono::milliseconds pause(100);
  for (;;) {
    api.pause(pause);
    std::error_code gone;
    const auto now = std::filesystem::last_write_time(file, gone);
    if (!gone && now != seen) return;
  }
}

/// Renders the file again and again, whenever it changes, until a signal ends it. What is wrong
/// with it is said, and waits for the next change.
void watch(const RenderArguments& arguments, const ServerChoice& server, const Delivery& deliver) {
  const std::filesystem::path file = arguments.scene.name;
  if (!std::filesystem::is_regular_file(file))
    throw InputError(
        fmt::format("--watch needs a scene in a file, and '{}' is none", arguments.scene.name));
  with_server(server, [&](Api& api) {
    for (;;) {
      std::error_code gone;
      const auto seen = std::filesystem::last_write_time(file, gone);
      try {
        if (const auto scene = read_scene_file(arguments.scene, arguments.overrides))
          deliver(render_scene(*scene, arguments.overrides, deliver.media_type(), api),
                  scene->label);
      } catch (const InputError& error) {
        notice(error.what());
      }
      wait_for_change(file, seen, api);
    }
  });
}

void render(const RenderArguments& arguments, const ServerChoice& server) {
  const Delivery deliver(arguments.output);
  if (arguments.watch) return watch(arguments, server, deliver);
  RenderedImage image;
  const SceneText scene = with_scene(
      arguments.scene, arguments.overrides, server, [&](Api& api, const SceneText& rendered) {
        image = render_scene(rendered, arguments.overrides, deliver.media_type(), api);
      });
  deliver(image, scene.label);
}

}  // namespace

void add_render(CLI::App& app, const ServerChoice& server) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App& command =
      add_scene_command(app, "render", "Render a scene to an image", arguments->scene);
  std::vector<std::string> endings;
  for (const ImageFormat& format : image_formats) endings.emplace_back(format.ending);
  add_output_option(command, arguments->output, "Image file: .png, .ppm or .pfm [the terminal]",
                    endings);
  command.add_flag("--watch", arguments->watch, "Render again whenever the file changes");
  add_accuracy_options(command, arguments->overrides);
  add_picture_options(command, arguments->overrides);
  command.callback([arguments, &server] { render(*arguments, server); });
}

}  // namespace raytracer::client

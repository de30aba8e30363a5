// raytracer render: the scene becomes a job, the job an image, the image a file or a picture in
// the terminal. The server is left before anything is written, however long a reader takes.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "client/commands.h"
#include "client/delivery.h"
#include "client/owned_job.h"
#include "client/scene_errors.h"
#include "client/terminal.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

RenderedImage render_scene(const SceneSource& scene, const Overrides& overrides, ImageFormat format,
                           Api& api) {
  try {
    OwnedJob job(api, api.start_job(scene.text, overrides));
    job.wait("rendering");
    return api.job_image(job.id(), format);
  } catch (const Refused& refused) {
    throw explain(refused, scene, overrides);
  }
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
  const std::filesystem::path file = arguments.scene;
  if (!std::filesystem::is_regular_file(file))
    throw InputError(
        fmt::format("--watch needs a scene in a file, and '{}' is none", arguments.scene));
  with_server(server, [&](Api& api) {
    for (;;) {
      std::error_code gone;
      const auto seen = std::filesystem::last_write_time(file, gone);
      try {
        if (const auto scene = read_scene_file(arguments.scene))
          deliver(render_scene(*scene, arguments.overrides, deliver.format(), api), scene->label);
      } catch (const InputError& error) {
        fmt::print(stderr, "{}\n", error.what());
      }
      wait_for_change(file, seen, api);
    }
  });
}

}  // namespace

void render(const RenderArguments& arguments, const ServerChoice& server) {
  const Delivery deliver(arguments.output);
  if (arguments.watch) return watch(arguments, server, deliver);
  RenderedImage image;
  const SceneSource scene = with_scene(
      arguments.scene, arguments.overrides, server, [&](Api& api, const SceneSource& rendered) {
        image = render_scene(rendered, arguments.overrides, deliver.format(), api);
      });
  deliver(image, scene.label);
}

}  // namespace raytracer::client

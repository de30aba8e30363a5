// raytracer tradeoff: what accuracy costs on a scene, measured by the server, as a drawing, a
// table or text.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/curve.h"
#include "client/notice.h"
#include "client/owned_job.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

struct TradeoffArguments {
  SceneChoice scene;
  std::optional<OutputFile> output;  ///< none: as text on standard output
  Overrides overrides;
};

std::string file_of(const std::string& json, const std::string& ending, const std::string& label) {
  if (ending == ".svg") return curve_svg(read_curve(json), label);
  return ending == ".csv" ? curve_csv(json) : json;
}

void tradeoff(const TradeoffArguments& arguments, const ServerChoice& server) {
  if (arguments.output) arguments.output->check_writable();
  Overrides query = arguments.overrides;
  query["task"] = "tradeoff";
  std::string json;
  const SceneText scene = with_scene(arguments.scene, arguments.overrides, server,
                                     [&](Api& api, const SceneText& measured) {
                                       OwnedJob job(api, api.start_job(measured, query));
                                       job.wait("measuring");
                                       json = api.job_result(job.id());
                                     });

  const Curve curve = read_curve(json);
  if (!arguments.output) {
    fmt::print("{}", curve_text(curve, scene.label));
    return;
  }
  arguments.output->write(file_of(json, arguments.output->ending(), scene.label));
  notice(fmt::format("{}: {} settings of {}", arguments.output->path.string(), curve.points.size(),
                     scene.label));
}

}  // namespace

void add_tradeoff(CLI::App& app, const ServerChoice& server) {
  const auto arguments = std::make_shared<TradeoffArguments>();
  CLI::App& command =
      add_scene_command(app, "tradeoff", "Measure error against tracing time", arguments->scene);
  add_output_option(command, arguments->output, "Curve file: .svg, .json or .csv [text]",
                    {".svg", ".json", ".csv"});
  add_picture_options(command, arguments->overrides);
  command.callback([arguments, &server] { tradeoff(*arguments, server); });
}

}  // namespace raytracer::client

// raytracer tradeoff: what accuracy costs on a scene, measured by the server, as a drawing, a
// table or text.
#include <fmt/format.h>

#include <string>

#include "client/atomic_file.h"
#include "client/commands.h"
#include "client/curve.h"
#include "client/curve_format.h"
#include "client/curve_svg.h"
#include "client/curve_text.h"
#include "client/owned_job.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

std::string file_of(const std::string& json, CurveFormat format, const std::string& label) {
  switch (format) {
    case CurveFormat::svg:
      return curve_svg(read_curve(json), label);
    case CurveFormat::csv:
      return csv(read_curve(json));
    case CurveFormat::json:
      break;
  }
  return json;
}

}  // namespace

void tradeoff(const TradeoffArguments& arguments, const ServerChoice& server) {
  if (arguments.output) check_writable(*arguments.output);
  Overrides query = arguments.overrides;
  query["task"] = "tradeoff";
  std::string json;
  const SceneSource scene = with_scene(arguments.scene, arguments.overrides, server,
                                       [&](Api& api, const SceneSource& measured) {
                                         OwnedJob job(api, api.start_job(measured.text, query));
                                         job.wait("measuring");
                                         json = api.job_result(job.id());
                                       });

  if (!arguments.output) {
    fmt::print("{}", curve_text(read_curve(json), scene.label));
    return;
  }
  const CurveFormat format = curve_format_of(*arguments.output).value();
  write_atomically(*arguments.output, file_of(json, format, scene.label));
  fmt::print(stderr, "{}: {} settings of {}\n", arguments.output->string(),
             read_curve(json).points.size(), scene.label);
}

}  // namespace raytracer::client

// raytracer convert: a file of another format as a scene document; such a document as it is.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/failure.h"
#include "client/formats/format.h"
#include "client/formats/printable.h"
#include "client/notice.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

struct ConvertArguments {
  SceneChoice scene;
  std::optional<OutputFile> output;  ///< none: standard output
};

/// Of a document no more is seen than that it is JSON: there is no server to say what is wrong.
void require_json(const SceneText& scene) {
  using nlohmann::json;
  const auto keep_nothing = [](int, json::parse_event_t, const json&) { return false; };
  try {
    [[maybe_unused]] const json nothing = json::parse(scene.text, keep_nothing);
  } catch (const json::exception& error) {
    const std::string_view what = error.what();
    const std::size_t begin = what.find("] ");  // behind the library's name for it
    throw InputError(fmt::format("{}: {}", scene.label,
                                 printable(begin == what.npos ? what : what.substr(begin + 2))));
  }
}

SceneText read_scene(const SceneChoice& choice, const ServerChoice& server) {
  std::optional<SceneText> scene = read_scene_file(choice);
  if (!scene)
    with_server(server, [&](Api& api) { scene = api.shipped_scene(choice.name); });
  else if (!format_of(choice.name))
    require_json(*scene);
  return *std::move(scene);
}

void convert(const ConvertArguments& arguments, const ServerChoice& server) {
  if (arguments.output) arguments.output->check_writable();
  const SceneText scene = read_scene(arguments.scene, server);
  if (!arguments.output) return write_to_standard_output(scene.text);
  arguments.output->write(scene.text);
  notice(fmt::format("{}: the scene of {}", arguments.output->path.string(), scene.label));
}

}  // namespace

void add_convert(CLI::App& app, const ServerChoice& server) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App& command = add_command(app, "convert", "Convert a file to a scene document");
  command.footer(
      fmt::format("Files: {}.\nThey need no server; a shipped scene does.", all_endings()));
  command.add_option("FILE", arguments->scene.name, "File, shipped scene, or - for standard input")
      ->required()
      ->option_text(" ");
  add_import_flags(command, arguments->scene);
  add_output_option(command, arguments->output, "Scene document: .json [standard output]",
                    {".json"});
  command.callback([arguments, &server] { convert(*arguments, server); });
}

}  // namespace raytracer::client

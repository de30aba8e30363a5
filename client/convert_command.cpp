// raytracer convert: a file of another format as a scene document. It needs no server.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/formats/format.h"

namespace raytracer::client {
namespace {

struct ConvertArguments {
  SceneChoice file;
  std::optional<OutputFile> output;  ///< none: standard output
};

std::string all_endings() {
  std::vector<std::string_view> endings;
  std::transform(formats.begin(), formats.end(), std::back_inserter(endings),
                 [](const Format& format) { return format.ending; });
  return fmt::format("{}", fmt::join(endings, ", "));
}

void convert_file(const ConvertArguments& arguments) {
  if (arguments.output) arguments.output->check_writable();
  const SceneText scene = read_scene_file(arguments.file).value();
  if (!arguments.output) return write_to_standard_output(scene.text);
  arguments.output->write(scene.text);
  fmt::print(stderr, "{}: the scene of {}\n", arguments.output->path.string(), scene.label);
}

}  // namespace

void add_convert(CLI::App& app, const ServerChoice&) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App& command = add_command(app, "convert", "Convert a file to a scene document");
  command.footer("It needs no server.");
  command.add_option("FILE", arguments->file.name, "File: " + all_endings())
      ->required()
      ->option_text(" ")
      ->check([](const std::string& path) {
        return format_of(path)
                   ? ""
                   : fmt::format("the ending of '{}' is none of {}", path, all_endings());
      });
  add_wish_options(command, arguments->file);
  add_output_option(command, arguments->output, "Scene document: .json [standard output]",
                    {".json"});
  command.callback([arguments] { convert_file(*arguments); });
}

}  // namespace raytracer::client

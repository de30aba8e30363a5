// Values are checked for what no server would take; limits are the server's to know.
#include "client/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <utility>

#include "client/failure.h"

namespace raytracer::client {
namespace {

constexpr int most = std::numeric_limits<int>::max();

/// An option that becomes the query parameter of its name: --max-depth is max_depth.
template <typename Value>
CLI::Option* add_override(CLI::App& command, Overrides& overrides, const std::string& flag,
                          const std::string& value_name, const std::string& help) {
  std::string parameter = flag.substr(2);
  std::replace(parameter.begin(), parameter.end(), '-', '_');
  const auto store = [&overrides, parameter](const Value& value) {
    overrides[parameter] = fmt::format("{}", value);
  };
  return command.add_option_function<Value>(flag, store, help)->option_text(value_name);
}

}  // namespace

RefuseValue refuse_unless_whole(int least, int most) {
  return [least, most](const std::string& text) {
    int value = 0;
    const bool is_whole = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return is_whole ? ""
                    : fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
  };
}

RefuseValue refuse_unless_among(std::vector<std::string> words) {
  return [words = std::move(words)](const std::string& text) {
    const bool is_one = std::find(words.begin(), words.end(), text) != words.end();
    const char* const are_not = words.size() == 1 ? "not" : "none of";
    return is_one ? "" : fmt::format("'{}' is {} {}", text, are_not, fmt::join(words, ", "));
  };
}

std::string refuse_unless_positive(const std::string& text) {
  double value = 0;
  const bool is_positive = CLI::detail::lexical_cast(text, value) && value > 0 &&
                           value <= std::numeric_limits<double>::max();
  return is_positive ? "" : fmt::format("'{}' is not a number greater than 0", text);
}

void add_server_options(CLI::App& app, ServerChoice& server) {
  app.add_option_function<std::string>(
         "--server", [&server](const std::string& url) { server.url = read_server_url(url); },
         "http[s]://HOST[:PORT] of a server (or RAYTRACER_SERVER)")
      ->option_text("URL");
  app.add_option_function<std::string>(
         "--token", [&server](const std::string& token) { server.token = token; },
         "Its bearer token (or RAYTRACER_TOKEN)")
      ->option_text("TOKEN")
      ->check([](const std::string& text) { return is_token(text) ? "" : what_a_token_has; });
}

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& purpose) {
  CLI::App* const command = app.add_subcommand(name, purpose);
  command->group("Commands");
  command->fallthrough();  // --server and --token may follow the command
  command->footer("--server and --token also apply; see raytracer --help.");
  return *command;
}

CLI::App& add_scene_command(CLI::App& app, const std::string& name, const std::string& purpose,
                            SceneChoice& scene) {
  CLI::App& command = add_command(app, name, purpose);
  command.add_option("SCENE", scene.name, "File, shipped scene, or - for standard input")
      ->required()
      ->option_text(" ");
  add_import_flags(command, scene);
  return command;
}

void add_accuracy_options(CLI::App& command, Overrides& overrides) {
  CLI::Option* const samples =
      add_override<int>(command, overrides, "--samples", "N", "Samples per pixel")
          ->check(refuse_unless_whole(1, most));
  CLI::Option* const target = add_override<double>(command, overrides, "--target-rmse", "X",
                                                   "Refine until the RMSE is most likely at most X")
                                  ->check(refuse_unless_positive);
  CLI::Option* const budget = add_override<double>(command, overrides, "--budget-ms", "T",
                                                   "Refine for at most T milliseconds of tracing")
                                  ->check(refuse_unless_positive);
  samples->excludes(target)->excludes(budget);
  add_override<std::string>(command, overrides, "--precision", "auto|single|double",
                            "Floating-point precision of the kernel")
      ->check(refuse_unless_among({"auto", "single", "double"}));
}

void add_picture_options(CLI::App& command, Overrides& overrides) {
  add_override<int>(command, overrides, "--width", "W", "Image width in pixels")
      ->check(refuse_unless_whole(1, most));
  add_override<int>(command, overrides, "--height", "H", "Image height in pixels")
      ->check(refuse_unless_whole(1, most));
  add_override<int>(command, overrides, "--max-depth", "N",
                    "Maximum number of reflections and refractions of a ray")
      ->check(refuse_unless_whole(0, most));
  add_override<std::string>(command, overrides, "--transfer", "linear|srgb",
                            "Transfer function of the image")
      ->check(refuse_unless_among({"linear", "srgb"}));
}

void add_output_option(CLI::App& command, std::optional<OutputFile>& output,
                       const std::string& help, const std::vector<std::string>& endings) {
  const auto refuse_others = [endings](const std::string& path) -> std::string {
    const bool is_known =
        std::find(endings.begin(), endings.end(), OutputFile{path}.ending()) != endings.end();
    return is_known
               ? ""
               : fmt::format("the ending of '{}' is none of {}", path, fmt::join(endings, ", "));
  };
  const auto store = [&output](const std::string& path) { output = OutputFile{path}; };
  command.add_option_function<std::string>("-o,--output", store, help)
      ->option_text("FILE")
      ->check(refuse_others);
}

}  // namespace raytracer::client

// Values are checked for what no server would take; limits are the server's to know.
#include "client/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "client/curve_format.h"
#include "client/failure.h"
#include "client/image_format.h"

namespace raytracer::client {
namespace {

constexpr const char* scene_help =
    "A file, - for standard input, or the name of a shipped scene (see raytracer scenes)";

constexpr const char* footer =
    "Without a server a private one is started on a free loopback port and stopped at the end.\n"
    "Exit status: 0; 1 the scene or the arguments are wrong; 2 the server could not be reached\n"
    "or failed.";

/// A check for CLI11: an integer in decimal digits, at least `least`.
CLI::Validator integer_from(long least) {
  return {[least](const std::string& text) -> std::string {
            const bool digits = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
            if (digits && text.size() <= 10 && std::stol(text) >= least) return {};
            return fmt::format("'{}' is not an integer from {} on", text, least);
          },
          ""};
}

/// A check for CLI11: a finite number greater than 0, which becomes one as JSON writes it.
CLI::Validator positive_number() {
  return {[](std::string& text) -> std::string {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool decimal = text.find_first_not_of("0123456789.+-eE") == text.npos;
            if (decimal && !text.empty() && *end == '\0' && std::isfinite(value) && value > 0) {
              text = fmt::format("{}", value);
              return {};
            }
            return fmt::format("'{}' is not a number greater than 0", text);
          },
          ""};
}

/// A check for CLI11: an ending that says the format of a `thing`.
template <typename Format>
CLI::Validator path_of(const char* thing,
                       std::optional<Format> (*format)(const std::filesystem::path&),
                       std::string_view endings) {
  return {[=](const std::string& text) -> std::string {
            if (format(text)) return {};
            return fmt::format("the ending of '{}' names no format of {}: {} are known", text,
                               thing, endings);
          },
          ""};
}

/// The options of a command that become query parameters.
class OverrideOptions {
 public:
  OverrideOptions(CLI::App& command, Overrides& overrides)
      : command_(command), overrides_(overrides) {}

  /// Those that say which picture.
  void add_picture() {
    add("width", "The image's width in pixels", "W", integer_from(1));
    add("height", "The image's height in pixels", "H", integer_from(1));
    add("max_depth", "How many times a ray may be reflected", "N", integer_from(0));
    add("transfer", "linear or srgb", "T",
        CLI::IsMember(std::vector<std::string>{"linear", "srgb"}));
  }

  /// Those that say how accurate.
  void add_accuracy() {
    CLI::Option* samples = add("samples", "Samples for each pixel", "N", integer_from(1));
    CLI::Option* target = add("target_rmse", "The error not to exceed: the cheapest such image",
                              "X", positive_number());
    CLI::Option* budget =
        add("budget_ms", "The time for tracing: the most accurate image within it", "T",
            positive_number());
    samples->excludes(target)->excludes(budget);
    add("precision", "auto, single or double", "P",
        CLI::IsMember(std::vector<std::string>{"auto", "single", "double"}));
  }

 private:
  CLI::Option* add(const std::string& parameter, const std::string& help, const std::string& value,
                   const CLI::Validator& check) {
    std::string flag = "--" + parameter;
    for (char& c : flag)
      if (c == '_') c = '-';
    Overrides& overrides = overrides_;
    const auto store = [&overrides, parameter](const std::string& text) {
      overrides[parameter] = text;
    };
    return command_.add_option_function<std::string>(flag, store, help)
        ->type_name(value)
        ->transform(check);
  }

  CLI::App& command_;
  Overrides& overrides_;
};

/// Anything that no option and no command took is an error; the first is enough.
void refuse_rest(const CLI::App& app) {
  for (const std::string& rest : app.remaining(true)) {
    if (rest == "--") continue;
    if (app.get_subcommands().empty() && !rest.starts_with('-'))
      throw InputError(
          fmt::format("there is no command '{}': render, plan, tradeoff, validate and "
                      "scenes are known, raytracer --help says more",
                      rest));
    throw InputError(fmt::format(
        "'{}' is not expected here: raytracer {}--help says what is", rest,
        app.get_subcommands().empty() ? "" : app.get_subcommands()[0]->get_name() + " "));
  }
  if (app.get_subcommands().empty())
    throw InputError(
        "a command is missing: render, plan, tradeoff, validate or scenes; raytracer --help says "
        "more");
}

/// The flag's value, or where it is not given the variable's, and which of them it was.
std::pair<std::string, std::string> flag_or_variable(const CLI::Option* flag,
                                                     const std::string& name,
                                                     const char* variable) {
  if (flag->count() > 0) return {flag->as<std::string>(), name};
  const char* value = std::getenv(variable);
  return {value == nullptr ? "" : value, variable};
}

ServerChoice server_choice(const CLI::Option* server, const CLI::Option* token) {
  ServerChoice choice;
  const auto [url, url_origin] = flag_or_variable(server, "--server", "RAYTRACER_SERVER");
  if (!url.empty() || server->count() > 0) choice.url = read_server_url(url, url_origin);
  const auto [secret, origin] = flag_or_variable(token, "--token", "RAYTRACER_TOKEN");
  for (const char c : secret)
    if (c <= ' ' || c > '~')
      throw InputError(origin + ": a token has printable ASCII characters without spaces only");
  choice.token = secret;
  return choice;
}

}  // namespace

std::variant<Arguments, HelpText> read_arguments(int argc, const char* const* argv) {
  CLI::App app("Renders scenes through a raytracer-server.", "raytracer");
  app.footer(footer);
  app.require_subcommand(0, 1);
  app.allow_extras();  // refuse_rest says more about them than CLI11 would
  app.set_help_flag("-h,--help", "Print this text");
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->label("REQUIRED", "");
  const CLI::Option* server =
      app.add_option("--server", "The daemon, http://HOST:PORT (or RAYTRACER_SERVER)")
          ->type_name("URL");
  const CLI::Option* token =
      app.add_option("--token", "What the daemon asks for (or RAYTRACER_TOKEN)")
          ->type_name("TOKEN");

  RenderArguments render_arguments;
  std::string output;
  CLI::App* render = app.add_subcommand("render", "Render a scene");
  render->add_option("SCENE", render_arguments.scene, scene_help)->required()->type_name("");
  const CLI::Option* output_option =
      render
          ->add_option("-o,--output", output,
                       "The image's file, .png, .ppm or .pfm; without it the image is shown in "
                       "the terminal, or written as PNG when standard output is no terminal")
          ->type_name("IMAGE")
          ->check(path_of("an image", format_of, known_endings));
  render->add_flag("--watch", render_arguments.watch,
                   "Render again whenever the scene's file changes, until Ctrl-C");
  OverrideOptions render_options(*render, render_arguments.overrides);
  render_options.add_accuracy();
  render_options.add_picture();

  PlanArguments plan_arguments;
  CLI::App* plan = app.add_subcommand(
      "plan", "Say what a scene requires, what the server would choose for it and what that takes");
  plan->add_option("SCENE", plan_arguments.scene, scene_help)->required()->type_name("");
  plan->add_flag("--json", plan_arguments.as_json, "The server's answer as it is");
  OverrideOptions plan_options(*plan, plan_arguments.overrides);
  plan_options.add_accuracy();
  plan_options.add_picture();

  TradeoffArguments tradeoff_arguments;
  std::string curve;
  CLI::App* tradeoff =
      app.add_subcommand("tradeoff", "Measure error against time for many settings of a scene");
  tradeoff->add_option("SCENE", tradeoff_arguments.scene, scene_help)->required()->type_name("");
  const CLI::Option* curve_option =
      tradeoff
          ->add_option("-o,--output", curve,
                       "The curve's file, .svg, .json or .csv; without it the curve is printed")
          ->type_name("CURVE")
          ->check(path_of("a curve", curve_format_of, known_curve_endings));
  OverrideOptions(*tradeoff, tradeoff_arguments.overrides).add_picture();

  ValidateArguments validate_arguments;
  CLI::App* validate = app.add_subcommand("validate", "Check a scene without rendering it");
  validate->add_option("SCENE", validate_arguments.scene, scene_help)->required()->type_name("");

  CLI::App* scenes = app.add_subcommand("scenes", "List the shipped scenes");
  for (CLI::App* command : {render, plan, tradeoff, validate, scenes}) {
    command->group("Commands");
    command->fallthrough();  // --server and --token may follow the command
    command->footer("--server and --token may stand here too: see raytracer --help.");
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return HelpText{app.help()};
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what());
  }
  refuse_rest(app);

  Arguments arguments{server_choice(server, token), ScenesArguments{}};
  if (render->parsed()) {
    if (output_option->count() > 0) render_arguments.output = output;
    arguments.command = std::move(render_arguments);
  } else if (plan->parsed()) {
    arguments.command = std::move(plan_arguments);
  } else if (tradeoff->parsed()) {
    if (curve_option->count() > 0) tradeoff_arguments.output = curve;
    arguments.command = std::move(tradeoff_arguments);
  } else if (validate->parsed()) {
    arguments.command = std::move(validate_arguments);
  }
  return arguments;
}

}  // namespace raytracer::client

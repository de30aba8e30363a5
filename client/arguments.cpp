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

/// The table of commands and options, and where their values go.
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;  // the options refer to members
  CommandLine& operator=(const CommandLine&) = delete;

  const CLI::App& app() const { return app_; }

  /// Throws CLI::ParseError and InputError.
  Arguments parse(int argc, const char* const* argv);

 private:
  CLI::App* add_command(const char* name, const char* purpose);
  CLI::App* add_command_on(std::string& scene, const char* name, const char* purpose);

  CLI::App app_{"Renders scenes through a raytracer-server.", "raytracer"};
  const CLI::Option* server_ = nullptr;
  const CLI::Option* token_ = nullptr;
  RenderArguments render_arguments_;
  PlanArguments plan_arguments_;
  TradeoffArguments tradeoff_arguments_;
  ValidateArguments validate_arguments_;
  std::string image_;
  std::string curve_;
  CLI::App* render_ = nullptr;
  CLI::App* plan_ = nullptr;
  CLI::App* tradeoff_ = nullptr;
  CLI::App* validate_ = nullptr;
};

CommandLine::CommandLine() {
  app_.footer(footer);
  app_.require_subcommand(0, 1);
  app_.allow_extras();  // refuse_rest says more about them than CLI11 would
  app_.set_help_flag("-h,--help", "Print this text");
  app_.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app_.get_formatter()->label("REQUIRED", "");
  server_ = app_.add_option("--server", "The daemon, http://HOST:PORT (or RAYTRACER_SERVER)")
                ->type_name("URL");
  token_ = app_.add_option("--token", "What the daemon asks for (or RAYTRACER_TOKEN)")
               ->type_name("TOKEN");

  render_ = add_command_on(render_arguments_.scene, "render", "Render a scene");
  render_
      ->add_option("-o,--output", image_,
                   "The image's file, .png, .ppm or .pfm; without it the image is shown in "
                   "the terminal, or written as PNG when standard output is no terminal")
      ->type_name("IMAGE")
      ->check(path_of("an image", format_of, known_endings));
  render_->add_flag("--watch", render_arguments_.watch,
                    "Render again whenever the scene's file changes, until Ctrl-C");
  OverrideOptions render_options(*render_, render_arguments_.overrides);
  render_options.add_accuracy();
  render_options.add_picture();

  plan_ = add_command_on(
      plan_arguments_.scene, "plan",
      "Say what a scene requires, what the server would choose for it and what that takes");
  plan_->add_flag("--json", plan_arguments_.as_json, "The server's answer as it is");
  OverrideOptions plan_options(*plan_, plan_arguments_.overrides);
  plan_options.add_accuracy();
  plan_options.add_picture();

  tradeoff_ = add_command_on(tradeoff_arguments_.scene, "tradeoff",
                             "Measure error against time for many settings of a scene");
  tradeoff_
      ->add_option("-o,--output", curve_,
                   "The curve's file, .svg, .json or .csv; without it the curve is printed")
      ->type_name("CURVE")
      ->check(path_of("a curve", curve_format_of, known_curve_endings));
  OverrideOptions(*tradeoff_, tradeoff_arguments_.overrides).add_picture();

  validate_ =
      add_command_on(validate_arguments_.scene, "validate", "Check a scene without rendering it");
  add_command("scenes", "List the shipped scenes");
}

CLI::App* CommandLine::add_command(const char* name, const char* purpose) {
  CLI::App* command = app_.add_subcommand(name, purpose);
  command->group("Commands");
  command->fallthrough();  // --server and --token may follow the command
  command->footer("--server and --token may stand here too: see raytracer --help.");
  return command;
}

CLI::App* CommandLine::add_command_on(std::string& scene, const char* name, const char* purpose) {
  CLI::App* command = add_command(name, purpose);
  command->add_option("SCENE", scene, scene_help)->required()->type_name("");
  return command;
}

Arguments CommandLine::parse(int argc, const char* const* argv) {
  app_.parse(argc, argv);
  refuse_rest(app_);

  Arguments arguments{server_choice(server_, token_), ScenesArguments{}};
  if (render_->parsed()) {
    if (render_->count("--output") > 0) render_arguments_.output = image_;
    arguments.command = std::move(render_arguments_);
  } else if (plan_->parsed()) {
    arguments.command = std::move(plan_arguments_);
  } else if (tradeoff_->parsed()) {
    if (tradeoff_->count("--output") > 0) tradeoff_arguments_.output = curve_;
    arguments.command = std::move(tradeoff_arguments_);
  } else if (validate_->parsed()) {
    arguments.command = std::move(validate_arguments_);
  }
  return arguments;
}

}  // namespace

std::variant<Arguments, HelpText> read_arguments(int argc, const char* const* argv) {
  CommandLine line;
  try {
    return line.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return HelpText{line.app().help()};
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what());
  }
}

void show_command_line(const std::function<void(const CLI::App&)>& look) {
  look(CommandLine().app());
}

}  // namespace raytracer::client

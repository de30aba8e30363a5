// raytracer plan: what the server would do with a scene, without rendering all of it.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/terminal.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

using Json = nlohmann::ordered_json;

/// Names on the left, wrapped text beside them.
class Columns {
 public:
  explicit Columns(int width) : width_(static_cast<std::size_t>(width)) {}

  void add(const std::string& name, const std::string& words) {
    std::string line = fmt::format("{:<{}}", name, margin);
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
      if (line.size() > margin && line.size() + 1 + word.size() > width_) {
        text_ += line + '\n';
        line = std::string(margin, ' ');
      }
      line += (line.size() > margin ? " " : "") + word;
    }
    text_ += line + '\n';
  }

  const std::string& text() const { return text_; }

 private:
  static constexpr std::size_t margin = 17;  // wider than any name
  std::size_t width_;
  std::string text_;
};

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// {"spheres": 2, "cylinders": 1, "planes": 0} as "2 spheres, 1 cylinder", ["a", "b"] as "a, b".
std::string words_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  std::vector<std::string> parts;
  for (const auto& [key, part] : value.items()) {
    if (value.is_array()) {
      parts.push_back(words_of(part));
    } else if (part != 0 && part != false) {
      std::string name = spaced(key);
      if (part == 1 && name.ends_with('s')) name.pop_back();
      parts.push_back(part == true ? name : fmt::format("{} {}", words_of(part), name));
    }
  }
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

void add_choice(Columns& columns, const std::string& name, const Json& choice) {
  columns.add(name, words_of(choice.at("choice")));
  if (!choice.contains("finders")) return columns.add("", choice.value("reason", ""));
  for (const Json& row : choice.at("finders"))
    columns.add(
        "", fmt::format("- {} {}: {}, because {}", row.value("objects", ""), row.value("rays", ""),
                        row.value("choice", ""), row.value("reason", "")));
}

void add_prediction(Columns& columns, const Json& prediction) {
  const auto number = [&](const char* key) {
    if (!prediction.contains(key)) return std::string("?");
    const double value = prediction.value(key, 0.0);
    return value < 1000 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
  };
  columns.add(
      "predicted time",
      fmt::format("{} ms to build, {} ms to trace on {} thread{}", number("build_ms"),
                  number("trace_ms"), number("threads"), number("threads") == "1" ? "" : "s"));
  columns.add("", prediction.value("time_reason", ""));
  columns.add("predicted error",
              fmt::format("{} with {} samples per pixel", number("error"), number("samples")));
  columns.add("", prediction.value("error_reason", ""));
}

/// As people read it, in lines of at most `width` where words allow. What the server's answer does
/// not say is left out.
std::string plan_text(const std::string& json, int width) {
  const Json plan = Json::parse(json);
  Columns columns(width);
  for (const auto& [key, value] : plan.items()) {
    if (key == "features") {
      for (const auto& [feature, what] : value.items())
        columns.add(spaced(feature), words_of(what));
    } else if (key == "prediction") {
      add_prediction(columns, value);
    } else if (value.is_object() && value.contains("choice")) {
      add_choice(columns, spaced(key), value);
    } else if (key == "health") {
      if (value.empty()) columns.add("health", "nothing strains the arithmetic");
      for (const Json& strain : value) columns.add("health", words_of(strain));
    }
  }
  return columns.text();
}

struct PlanArguments {
  SceneChoice scene;
  bool as_json = false;  ///< the server's own answer
  Overrides overrides;
};

void plan(const PlanArguments& arguments, const ServerChoice& server) {
  std::string json;
  with_scene(arguments.scene, arguments.overrides, server, [&](Api& api, const SceneText& scene) {
    json = api.plan(scene, arguments.overrides);
  });
  constexpr int most_columns = 100;  // longer lines are hard to read
  const int columns = std::min(terminal_size(STDOUT_FILENO).columns, most_columns);
  fmt::print("{}", arguments.as_json ? json : plan_text(json, columns));
}

}  // namespace

void add_plan(CLI::App& app, const ServerChoice& server) {
  const auto arguments = std::make_shared<PlanArguments>();
  CLI::App& command = add_scene_command(
      app, "plan", "Show the plan and its predicted time and error", arguments->scene);
  command.add_flag("--json", arguments->as_json, "Print the plan as JSON");
  add_accuracy_options(command, arguments->overrides);
  add_picture_options(command, arguments->overrides);
  command.callback([arguments, &server] { plan(*arguments, server); });
}

}  // namespace raytracer::client

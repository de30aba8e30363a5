#include "server/query.h"

#include <fmt/format.h>

#include <array>

#include "engine/engine.h"
#include "server/problem.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

/// One parameter as it came, to be read as what it should be.
struct Parameter {
  const std::string& name;
  const std::string& text;

  [[noreturn]] void refuse_for(std::string_view rule) const {
    refuse(400,
           fmt::format("The query parameter \"{}\" is \"{}\" but must be {}", name, text, rule));
  }
};

int integer(const Parameter& parameter) {
  const std::optional<int> value = read_int(parameter.text);
  if (!value) parameter.refuse_for("an integer, such as 4");
  return *value;
}

double number(const Parameter& parameter) {
  const std::optional<double> value = read_double(parameter.text);
  if (!value) parameter.refuse_for("a number, such as 0.5 or 1e-3");
  return *value;
}

Vec3 point(const Parameter& parameter) {
  const std::vector<std::string_view> parts = parts_of(parameter.text, ',');
  std::vector<double> values;
  for (const std::string_view part : parts)
    if (const std::optional<double> value = read_double(part)) values.push_back(*value);
  if (parts.size() != 3 || values.size() != 3)
    parameter.refuse_for("three numbers x,y,z, such as 0,1.5,-4");
  return {values[0], values[1], values[2]};
}

Precision precision(const Parameter& parameter) {
  if (parameter.text == "auto") return Precision::automatic;
  if (parameter.text == "single") return Precision::single_precision;
  if (parameter.text == "double") return Precision::double_precision;
  parameter.refuse_for("auto, single or double");
}

Transfer transfer(const Parameter& parameter) {
  if (parameter.text == "linear") return Transfer::linear;
  if (parameter.text == "srgb") return Transfer::srgb;
  parameter.refuse_for("linear or srgb");
}

/// A row of the table of parameters: its name and what it does.
struct Row {
  std::string_view name;
  void (*apply)(RenderQuery&, const Parameter&);
  bool needs_scene = false;  ///< a posted document says its own
};

using Query = RenderQuery;
using Text = Parameter;

constexpr std::array<Row, 13> rows{{
    {"scene", [](Query& q, const Text& t) { q.scene = t.text; }},
    {"width", [](Query& q, const Text& t) { q.overrides.width = integer(t); }},
    {"height", [](Query& q, const Text& t) { q.overrides.height = integer(t); }},
    {"samples", [](Query& q, const Text& t) { q.overrides.samples = integer(t); }},
    {"target_rmse", [](Query& q, const Text& t) { q.overrides.target_rmse = number(t); }},
    {"budget_ms", [](Query& q, const Text& t) { q.overrides.budget_ms = number(t); }},
    {"precision", [](Query& q, const Text& t) { q.overrides.precision = precision(t); }},
    {"transfer", [](Query& q, const Text& t) { q.overrides.transfer = transfer(t); }},
    {"max_depth", [](Query& q, const Text& t) { q.overrides.max_depth = integer(t); }},
    {"origin", [](Query& q, const Text& t) { q.overrides.origin = point(t); }, true},
    {"look_at", [](Query& q, const Text& t) { q.overrides.look_at = point(t); }, true},
    {"up", [](Query& q, const Text& t) { q.overrides.up = point(t); }, true},
    {"fov", [](Query& q, const Text& t) { q.overrides.fov = number(t); }, true},
}};

const Row& row_of(std::string_view name) {
  for (const Row& row : rows)
    if (row.name == name) return row;
  refuse(400,
         fmt::format("Unknown query parameter \"{}\"{}", name, did_you_mean(name, query_names())));
}

}  // namespace

std::vector<std::string_view> query_names() {
  std::vector<std::string_view> names;
  names.reserve(std::size(rows));
  for (const Row& row : rows) names.push_back(row.name);
  return names;
}

void require_given_once(const httplib::Params& params, const std::string& name) {
  if (params.count(name) > 1)
    refuse(400, fmt::format("The query parameter \"{}\" is given more than once", name));
}

RenderQuery read_query(const httplib::Params& params) {
  RenderQuery query;
  for (const auto& [name, text] : params) {
    require_given_once(params, name);
    const Row& row = row_of(name);
    if (row.needs_scene && params.count("scene") == 0)
      refuse(400, fmt::format("The query parameter \"{}\" goes with \"scene=NAME\" only: "
                              "a posted document says its own camera",
                              name));
    row.apply(query, {name, text});
  }
  const Overrides& over = query.overrides;
  if (over.samples && (over.target_rmse || over.budget_ms))
    refuse(400, fmt::format(
                    "The query parameters \"samples\" and \"{}\" do not go together: leave one out",
                    over.target_rmse ? "target_rmse" : "budget_ms"));
  return query;
}

}  // namespace raytracer

#include "server/query.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/engine.h"
#include "server/problem.h"

namespace raytracer {
namespace {

[[noreturn]] void refuse(std::string detail) { throw HttpError({400, std::move(detail)}); }

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+') {
      result += ' ';
    } else if (text[i] != '%') {
      result += text[i];
    } else {
      const int high = i + 2 < text.size() ? hex_value(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? hex_value(text[i + 2]) : -1;
      if (high < 0 || low < 0)
        refuse(fmt::format("The query has a % that two hexadecimal digits do not follow: \"{}\"",
                           text));
      result += static_cast<char>(16 * high + low);
      i += 2;
    }
  }
  return result;
}

/// One parameter as it came, to be read as what it should be.
struct Parameter {
  const std::string& name;
  const std::string& text;

  [[noreturn]] void refuse_for(std::string_view rule) const {
    refuse(fmt::format("The query parameter \"{}\" is \"{}\" but must be {}", name, text, rule));
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
  std::array<double, 3> values{};
  std::string_view rest = parameter.text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t comma = i < 2 ? rest.find(',') : rest.size();
    const std::optional<double> value =
        comma == std::string_view::npos ? std::nullopt : read_double(rest.substr(0, comma));
    if (!value) parameter.refuse_for("three numbers x,y,z, such as 0,1.5,-4");
    values[i] = *value;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
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
};

using Query = RenderQuery;
using Text = Parameter;

// `task` last: it is known to jobs only.
constexpr std::array<Row, 14> rows{{
    {"scene", [](Query& q, const Text& t) { q.scene = t.text; }},
    {"width", [](Query& q, const Text& t) { q.overrides.width = integer(t); }},
    {"height", [](Query& q, const Text& t) { q.overrides.height = integer(t); }},
    {"samples", [](Query& q, const Text& t) { q.overrides.samples = integer(t); }},
    {"target_rmse", [](Query& q, const Text& t) { q.overrides.target_rmse = number(t); }},
    {"budget_ms", [](Query& q, const Text& t) { q.overrides.budget_ms = number(t); }},
    {"precision", [](Query& q, const Text& t) { q.overrides.precision = precision(t); }},
    {"transfer", [](Query& q, const Text& t) { q.overrides.transfer = transfer(t); }},
    {"max_depth", [](Query& q, const Text& t) { q.overrides.max_depth = integer(t); }},
    {"origin", [](Query& q, const Text& t) { q.overrides.origin = point(t); }},
    {"look_at", [](Query& q, const Text& t) { q.overrides.look_at = point(t); }},
    {"up", [](Query& q, const Text& t) { q.overrides.up = point(t); }},
    {"fov", [](Query& q, const Text& t) { q.overrides.fov = number(t); }},
    {"task", [](Query& q, const Text& t) { q.task = t.text; }},
}};

const Row& row_of(std::string_view name, QueryOf request) {
  const std::vector<std::string_view> known = query_names(request);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] == name) return rows[i];
  refuse(fmt::format("Unknown query parameter \"{}\"; did you mean \"{}\"?", name,
                     nearest_key(name, known)));
}

void refuse_contradictions(const RenderQuery& query) {
  const Overrides& over = query.overrides;
  if (over.samples && (over.target_rmse || over.budget_ms))
    refuse(
        fmt::format("The query parameters \"samples\" and \"{}\" do not go together: leave one out",
                    over.target_rmse ? "target_rmse" : "budget_ms"));
  if (query.scene) return;
  const std::array<std::pair<bool, std::string_view>, 4> camera{
      {{over.origin.has_value(), "origin"},
       {over.look_at.has_value(), "look_at"},
       {over.up.has_value(), "up"},
       {over.fov.has_value(), "fov"}}};
  for (const auto& [given, name] : camera)
    if (given)
      refuse(
          fmt::format("The query parameter \"{}\" goes with \"scene=NAME\" only: "
                      "a posted document says its own camera",
                      name));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> split_query(std::string_view target) {
  std::vector<std::pair<std::string, std::string>> parameters;
  const std::size_t mark = target.find('?');
  std::string_view rest = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(item.size() + 1, rest.size()));
    if (item.empty()) continue;
    const std::size_t equals = std::min(item.find('='), item.size());
    std::string name = decoded(item.substr(0, equals));
    for (const auto& [earlier, value] : parameters)
      if (earlier == name)
        refuse(fmt::format("The query parameter \"{}\" is given more than once", name));
    parameters.emplace_back(std::move(name),
                            decoded(item.substr(std::min(equals + 1, item.size()))));
  }
  return parameters;
}

std::vector<std::string_view> query_names(QueryOf request) {
  std::vector<std::string_view> names;
  names.reserve(std::size(rows));
  for (const Row& row : rows) names.push_back(row.name);
  if (request != QueryOf::job) names.pop_back();
  return names;
}

RenderQuery read_query(std::string_view target, QueryOf request) {
  RenderQuery query;
  for (const auto& [name, text] : split_query(target))
    row_of(name, request).apply(query, {name, text});
  refuse_contradictions(query);
  return query;
}

std::optional<double> read_double(std::string_view text) {
  constexpr std::size_t longest = 400;  // the longest exact decimal double has some 330 digits
  if (text.empty() || text.size() > longest) return {};
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return {};
  const auto value = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (!value.is_number()) return {};
  return value.get<double>();
}

std::optional<int> read_int(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return {};
  if (error == std::errc::result_out_of_range)
    return text[0] == '-' ? std::numeric_limits<int>::min() : std::numeric_limits<int>::max();
  if (error != std::errc{}) return {};
  return value;
}

}  // namespace raytracer

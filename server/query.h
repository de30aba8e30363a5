// The query of /render, /plan and /jobs: which scene, which task, and what stands over the
// document.
//
// Strict on purpose: a parameter that is ignored renders something else than was asked for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/engine.h"

namespace raytracer {

/// Names and values in order, decoded (%41, and + for a space).
/// Throws HttpError 400 for a malformed escape or a repeated name.
std::vector<std::pair<std::string, std::string>> split_query(std::string_view target);

struct RenderQuery {
  std::optional<std::string> scene;  ///< a name or an id; without it the body is the scene
  std::string task = "render";       ///< /jobs only
  Overrides overrides;
};

/// Which requests a query belongs to: only jobs have a task.
enum class QueryOf { render, job };

/// The names that read_query knows.
std::vector<std::string_view> query_names(QueryOf request);

/// Reads the query of a request's target ("/render?samples=4").
/// Throws HttpError 400 whose detail names the parameter. Integers beyond int become the nearest
/// int, which is beyond every limit, so that the limits answer.
RenderQuery read_query(std::string_view target, QueryOf request);

/// A JSON number, whatever the locale; nothing for anything else, "nan" and "1e999" included.
std::optional<double> read_double(std::string_view text);

/// Decimal digits with an optional "-"; beyond int, the nearest int.
std::optional<int> read_int(std::string_view text);

}  // namespace raytracer

// The query of /render, /plan and /jobs: which scene, and what stands over the document.
//
// Strict on purpose: a parameter that is ignored renders something else than was asked for.
#pragma once

#include <httplib.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/engine.h"

namespace raytracer {

/// What a query says.
struct RenderQuery {
  std::optional<std::string> scene;  ///< a name or an id; without it the body is the scene
  Overrides overrides;
};

/// The names that read_query knows.
std::vector<std::string_view> query_names();

/// Throws HttpError 400 if the query has this parameter more than once.
void require_given_once(const httplib::Params& params, const std::string& name);

/// Reads what httplib has decoded. Throws HttpError 400 whose detail names the parameter. Integers
/// beyond int become the nearest int, which is beyond every limit, so that the limits answer.
RenderQuery read_query(const httplib::Params& params);

}  // namespace raytracer

#include "server/route_table.h"

#include <fmt/format.h>

#include <optional>

#include "server/problem.h"

namespace raytracer {
namespace {

/// What {name} stands for if the path fits the pattern ("" for patterns without one).
std::optional<std::string> fit(std::string_view pattern, std::string_view path) {
  const std::size_t hole = pattern.find('{');
  if (hole == std::string_view::npos)
    return path == pattern ? std::optional<std::string>("") : std::nullopt;
  const std::string_view before = pattern.substr(0, hole);
  const std::string_view after = pattern.substr(pattern.find('}') + 1);
  if (path.size() <= before.size() + after.size()) return {};
  if (!path.starts_with(before) || !path.ends_with(after)) return {};
  const std::string_view inside =
      path.substr(before.size(), path.size() - before.size() - after.size());
  if (inside.find('/') != std::string_view::npos) return {};
  return std::string(inside);
}

/// Adds the route's methods to a list, as Allow has them.
void add_methods(std::string& list, const Route& route) {
  const std::string methods = route.method == "GET" ? "GET, HEAD" : route.method;
  if (list.find(methods) != std::string::npos) return;
  list.append(list.empty() ? "" : ", ").append(methods);
}

/// A GET's route answers HEAD too.
std::string_view method_of_route(std::string_view method) {
  return method == "HEAD" ? "GET" : method;
}

}  // namespace

std::string RouteTable::methods() const {
  std::string list;
  for (const Route& route : routes_) add_methods(list, route);
  return list;
}

const Route* RouteTable::find(std::string_view method, std::string_view path) const {
  const std::string_view wanted = method_of_route(method);
  for (const Route& route : routes_)
    if (route.method == wanted && fit(route.pattern, path)) return &route;
  return nullptr;
}

RouteTable::Match RouteTable::match(std::string_view method, std::string_view path) const {
  const std::string_view wanted = method_of_route(method);
  std::string allowed;
  for (const Route& route : routes_) {
    std::optional<std::string> captured = fit(route.pattern, path);
    if (!captured) continue;
    if (route.method == wanted) return {route, *std::move(captured)};
    add_methods(allowed, route);
  }
  if (allowed.empty())
    refuse(404, fmt::format("There is nothing at {}{}", path,
                            find("GET", "/") ? "; the page is at /" : ""));  // workers have none
  refuse(405, fmt::format("{} is not among the methods of {}: {}", method, path, allowed),
         {{"Allow", allowed}});
}

}  // namespace raytracer

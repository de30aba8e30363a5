// Which handler a request belongs to: a list of methods and patterns, matched as text.
//
// httplib would match with std::regex, which recurses once for each character of the path, and
// could not tell a wrong method (405) from an unknown path (404).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/call.h"

namespace raytracer {

/// What may follow a request's header.
enum class RequestBody { none, scene };

/// A row of the table: which requests, and what answers them.
struct Route {
  std::string method;   ///< GET also answers HEAD
  std::string pattern;  ///< a path; one {name} in it is a segment, not empty
  RequestBody body = RequestBody::none;
  Handler handler;
  bool is_public = false;   ///< needs no token
  bool on_workers = false;  ///< is there on a cluster's workers too
};

/// All routes, of which the first that fits answers.
class RouteTable {
 public:
  explicit RouteTable(std::vector<Route> routes) : routes_(std::move(routes)) {}

  struct Match {
    const Route& route;
    std::string captured;  ///< what {name} stood for
  };

  const std::vector<Route>& routes() const { return routes_; }

  /// Every method that some route has, as Allow lists them.
  std::string methods() const;

  /// The route, or null if there is none.
  const Route* find(std::string_view method, std::string_view path) const;

  /// Throws HttpError: 404 for an unknown path, 405 with Allow for another method.
  Match match(std::string_view method, std::string_view path) const;

 private:
  std::vector<Route> routes_;
};

}  // namespace raytracer

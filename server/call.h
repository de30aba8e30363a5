// One request on its way through a handler: what came, where the answer goes, and whether the body
// is still on the connection.
#pragma once

#include <httplib.h>

#include <functional>
#include <string>

namespace raytracer {

/// One request to be answered.
struct Call {
  const httplib::Request& request;
  httplib::Response& response;
  std::string captured{};  ///< what stood for {name} in the route's pattern
  const httplib::ContentReader* content = nullptr;  ///< none for methods without a body
  bool body_was_read = false;

  bool is_head() const { return request.method == "HEAD"; }
};

/// Answers a call, or throws HttpError.
using Handler = std::function<void(Call&)>;

/// All values of a header field as one list.
inline std::string header_list(const httplib::Request& request, const std::string& name) {
  std::string list;
  const auto [begin, end] = request.headers.equal_range(name);
  for (auto field = begin; field != end; ++field) {
    if (!list.empty()) list += ", ";
    list += field->second;
  }
  return list;
}

}  // namespace raytracer

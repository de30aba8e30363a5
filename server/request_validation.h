// Request validation: what every request must fulfil before its handler, before its body is read.
#pragma once

#include <httplib.h>

#include "server/config.h"
#include "server/route_table.h"

namespace raytracer {

/// Throws HttpError, in this order: 414 for a long target, 400 for field names that proxies read
/// otherwise and for none or several Hosts, 401 without the token, 404, 405, and what body.h says
/// about the body.
void validate_request(const httplib::Request& request, const RouteTable& routes,
                      const Config& config);

}  // namespace raytracer

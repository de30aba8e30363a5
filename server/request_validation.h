// Request validation: what every request must fulfil before its handler, before its body is read.
#pragma once

#include <httplib.h>

#include "server/config.h"
#include "server/route_table.h"

namespace raytracer {

/// Throws HttpError, in this order: 414 for a long target; 400 for field names that proxies read
/// otherwise and for none or several Hosts; 401 without the token, where the route is not public;
/// 404, 405. Where the route takes no body: 400 if there is one. Where it takes a scene, unless the
/// query names one: 411 without a length or with a transfer coding, 400 for a length that is no
/// number, 413 for too many bytes, 415 for another type or coding, 400 for a body beside scene=.
void validate_request(const httplib::Request& request, const RouteTable& routes,
                      const Config& config);

}  // namespace raytracer

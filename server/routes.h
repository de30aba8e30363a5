// The service's table of contents.
#pragma once

#include "server/route_table.h"
#include "server/services.h"

namespace raytracer {

/// Every request that this server answers. `services` must outlive the table.
RouteTable make_routes(Services& services);

}  // namespace raytracer

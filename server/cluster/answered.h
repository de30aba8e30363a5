// Where a request needs the cluster: what NATS says as what HTTP says.
#pragma once

#include "server/cluster/nats.h"
#include "server/problem.h"

namespace raytracer {

/// Does what it is given. Throws HttpError: 503 with Retry-After if NATS is away, or the store is
/// full; what else NATS refuses is this server's fault and stays what it is.
template <typename Work>
auto answered(const Work& work) {
  try {
    return work();
  } catch (const NatsUnavailable& error) {
    refuse(503,
           std::string("The cluster cannot be reached now (") + error.what() +
               "); renders that are predicted to be short go on here, the rest has to wait",
           {{"Retry-After", "2"}});
  } catch (const StreamFull& error) {
    refuse(503,
           std::string("The cluster's store is full (--max-stored; ") + error.what() +
               "); delete jobs, or wait until old ones are forgotten",
           {{"Retry-After", "30"}});
  }
}

}  // namespace raytracer

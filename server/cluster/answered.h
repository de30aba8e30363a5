// Where a request needs the cluster: what NATS says as what HTTP says.
#pragma once

#include "server/cluster/nats.h"
#include "server/problem.h"

namespace raytracer {

/// Seconds.
inline constexpr const char* full_store_retry_after = "30";

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
    refuse(503, error.what(), {{"Retry-After", full_store_retry_after}});
  }
}

}  // namespace raytracer

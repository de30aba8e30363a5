// Everything that the handlers share, in the order in which it has to begin and end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/catalog.h"
#include "server/cluster/cluster.h"
#include "server/config.h"
#include "server/disconnect_watch.h"
#include "server/etag.h"
#include "server/image_cache.h"
#include "server/job_events.h"
#include "server/local_jobs.h"
#include "server/metrics.h"
#include "server/quota.h"
#include "server/request_log.h"
#include "server/scenes.h"

namespace raytracer {

/// Renders that share the worker pool tile by tile; more would only make all of them late.
inline constexpr std::size_t renders_at_once = 4;

/// Bytes of all bodies together that fit in any case: many, however small the largest may be.
inline constexpr std::int64_t least_body_memory = 64 << 20;

struct Services {
  explicit Services(const Config& configuration)
      : config(configuration),
        log(config.quiet),
        body_memory(std::max(2 * config.limits.body, least_body_memory),
                    "The bodies of other requests fill the memory for them; try again later",
                    [this] { return admission.retry_after_s(); }),
        admission(renders_at_once, config.max_queue),
        pool(config.threads),
        renderer_id(renderer_id_of(this_machine())),
        scenes(catalog, config.limits, config.max_kept, config.max_cache,
               [this](const std::string& id) {
                 return cluster ? cluster->kept_scene(id) : std::optional<std::string>();
               }),
        image_cache(config.max_cache, admission, disconnect_watch) {
    if (config.cluster.nats_url.empty())
      local_jobs.emplace(admission, pool, config.limits, metrics, log);
    else
      cluster.emplace(Cluster::Parts{config, renderer_id, machine_costs(), renders_at_once,
                                     admission, pool, scenes, metrics, log});
  }

  /// Measured at the first call, which takes some milliseconds: in a cluster at the start, else for
  /// the first forecast. With threads of its own, which renders do not keep.
  const MachineCosts& machine_costs() {
    std::call_once(costs_measured, [&] {
      WorkerPool idle(config.threads);
      costs = measure_machine_costs(idle);
    });
    return costs;
  }

  Jobs& jobs() { return cluster ? cluster->jobs() : static_cast<Jobs&>(*local_jobs); }

  const Config config;
  RequestLog log;
  Metrics metrics{};
  const Catalog catalog{};
  Quota body_memory;  ///< also for the scenes read from them: --max-body bounds a single one
  Admission admission;
  WorkerPool pool;
  const std::string renderer_id;  ///< in the entity tags of pictures
  std::once_flag costs_measured{};
  MachineCosts costs{};  ///< for machine_costs() alone
  DisconnectWatch disconnect_watch{};
  Quota event_streams{most_event_streams,
                      "All event streams of this server are open; ask for the job itself from time "
                      "to time instead",
                      [this] { return admission.retry_after_s(); }};
  Scenes scenes;
  ImageCache image_cache;
  // One of the two, which ends first: its threads use what is above.
  std::optional<LocalJobs> local_jobs;
  std::optional<Cluster> cluster;
};

}  // namespace raytracer

// Everything that the handlers share, in the order in which it has to begin and end.
#pragma once

#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/body_budget.h"
#include "server/catalog.h"
#include "server/config.h"
#include "server/disconnect_watch.h"
#include "server/etag.h"
#include "server/event_streams.h"
#include "server/image_cache.h"
#include "server/jobs.h"
#include "server/metrics.h"
#include "server/request_log.h"
#include "server/scenes.h"

namespace raytracer {

/// Renders that share the worker pool tile by tile; more would only make all of them late.
inline constexpr std::size_t renders_at_once = 4;

struct Services {
  explicit Services(const Config& configuration)
      : config(configuration),
        log(config.quiet),
        body_budget(2 * config.limits.body),
        admission(renders_at_once, config.max_queue),
        pool(config.threads),
        renderer_id(renderer_id_of(this_machine())),
        machine_costs(measure_machine_costs(pool)),
        scenes(catalog, config.limits, config.max_kept, config.max_cache),
        image_cache(config.max_cache, admission, disconnect_watch),
        jobs(admission, pool, config.limits, renders_at_once, metrics,
             [this](std::string_view text) { log.note(text); }) {}

  const Config config;
  RequestLog log;
  Metrics metrics{};
  const Catalog catalog{};
  BodyBudget body_budget;
  Admission admission;
  WorkerPool pool;
  const std::string renderer_id;     ///< in the entity tags of pictures
  const MachineCosts machine_costs;  ///< measured before anyone waits
  DisconnectWatch disconnect_watch{};
  EventStreams event_streams{};
  Scenes scenes;
  ImageCache image_cache;
  Jobs jobs;  ///< ends first: its threads use what is above
};

}  // namespace raytracer

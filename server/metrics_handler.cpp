// GET /metrics: what was counted so far, and beside it what is true now. It waits for no render and
// reads no scene.
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "engine/engine.h"
#include "server/answer.h"
#include "server/handlers.h"

namespace raytracer {
namespace {

void set_load(Metrics& metrics, Services& services) {
  const Admission::Load load = services.admission.load();
  metrics.set("renders_running", static_cast<double>(load.running));
  metrics.set("queue_length", static_cast<double>(load.waiting));
  metrics.set("queue_limit", static_cast<double>(services.config.max_queue));
  metrics.set("event_streams_open", static_cast<double>(services.event_streams.taken()));
  if (services.cluster) return services.cluster->set_metrics();
  std::map<JobStatus, std::size_t> jobs = services.jobs().counts();
  for (const JobStatus status : job_statuses)
    metrics.set("jobs", static_cast<double>(jobs[status]), {name_of(status)});
}

void set_caches(Metrics& metrics, const Services& services) {
  for (const auto& [name, counts] :
       {std::pair<std::string_view, LruCounts>{"images", services.image_cache.cache_counts()},
        {"kept_scenes", services.scenes.kept()},
        {"read_scenes", services.scenes.read_lately()}}) {
    const auto set = [&, cache = name](MetricName metric, auto value) {
      metrics.set(metric, static_cast<double>(value), {cache});
    };
    set("cache_hits_total", counts.hits);
    set("cache_misses_total", counts.misses);
    set("cache_evictions_total", counts.evictions);
    set("cache_entries", counts.entries);
    set("cache_bytes", counts.bytes);
  }
}

void set_process(Metrics& metrics, const Services& services) {
  metrics.set("build_info", 1, {version, build_id, this_machine().instruction_set.name});
  metrics.set("render_threads", static_cast<double>(services.config.threads));
  // What the system says about this process, where it does: Linux.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream fields(line);
    std::string name;
    double value = 0;
    if (!(fields >> name >> value)) continue;
    if (name == "VmRSS:")  // "VmRSS:   5120 kB"
      metrics.set("process_resident_memory_bytes", value * 1024);
    if (name == "Threads:") metrics.set("process_threads", value);
  }
}

}  // namespace

void get_metrics(Services& services, Call& call) {
  set_load(services.metrics, services);
  set_caches(services.metrics, services);
  set_process(services.metrics, services);
  answer_bytes(call.response, services.metrics.text(), "text/plain; version=0.0.4; charset=utf-8");
}

}  // namespace raytracer

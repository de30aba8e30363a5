// GET /metrics: what Prometheus scrapes. It waits for no render and reads no scene.
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/answer.h"
#include "server/exposition.h"
#include "server/handlers.h"

namespace raytracer {
namespace {

void write_present(Exposition& out, const Services& services) {
  const Admission::Load load = services.admission.load();
  out.family("raytracer_renders_running", "gauge", "Renders and plans in an admission slot.",
             static_cast<double>(load.running));
  out.family("raytracer_queue_length", "gauge",
             "Renders and plans that wait for an admission slot.",
             static_cast<double>(load.waiting));
  out.family("raytracer_queue_limit", "gauge", "The most that may wait (--max-queue).",
             static_cast<double>(services.config.max_queue));
  out.family("raytracer_jobs", "gauge", "Jobs that are not forgotten, by status.");
  std::map<JobStatus, std::size_t> jobs = services.jobs.counts();
  for (const JobStatus status : job_statuses)
    out.sample(static_cast<double>(jobs[status]), {{"status", name_of(status)}});
  out.family("raytracer_event_streams_open", "gauge", "Event streams about jobs.",
             static_cast<double>(services.event_streams.open_count()));
}

void write_caches(Exposition& out, const Services& services) {
  struct Row {
    std::string_view cache;
    LruCounts counts;
  };
  const std::array<Row, 3> rows{{{"images", services.image_cache.cache_counts()},
                                 {"kept_scenes", services.scenes.kept()},
                                 {"read_scenes", services.scenes.read_lately()}}};
  const auto write = [&](std::string_view name, std::string_view type, std::string_view help,
                         auto LruCounts::*value) {
    out.family(name, type, help);
    for (const Row& row : rows)
      out.sample(static_cast<double>(row.counts.*value), {{"cache", row.cache}});
  };
  write("raytracer_cache_hits_total", "counter", "Look-ups that found it.", &LruCounts::hits);
  write("raytracer_cache_misses_total", "counter", "Look-ups that did not.", &LruCounts::misses);
  write("raytracer_cache_evictions_total", "counter", "What went because the memory was full.",
        &LruCounts::evictions);
  write("raytracer_cache_entries", "gauge", "What is kept now.", &LruCounts::entries);
  write("raytracer_cache_bytes", "gauge", "The memory that it takes.", &LruCounts::bytes);
  out.family("raytracer_renders_shared_total", "counter",
             "Requests that waited for another's render of the same picture.");
  out.sample(static_cast<double>(services.image_cache.shared_count()));
}

void write_process(Exposition& out, const Services& services) {
  out.family("raytracer_build_info", "gauge", "What this server is; its value is always 1.");
  out.sample(1, {{"version", version},
                 {"build_id", build_id},
                 {"instruction_set", this_machine().instruction_set.name}});
  out.family("raytracer_render_threads", "gauge", "Threads that trace (--threads).",
             static_cast<double>(services.config.threads));
  // What the system says about this process, where it does: Linux.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream fields(line);
    std::string name;
    double value = 0;
    if (!(fields >> name >> value)) continue;
    if (name == "VmRSS:")  // "VmRSS:   5120 kB"
      out.family("raytracer_process_resident_memory_bytes", "gauge",
                 "Memory that the process holds.", value * 1024);
    if (name == "Threads:")
      out.family("raytracer_process_threads", "gauge", "Threads of the process.", value);
  }
}

}  // namespace

void get_metrics(Services& services, Call& call) {
  Exposition out;
  services.metrics.write(out);
  write_present(out, services);
  write_caches(out, services);
  write_process(out, services);
  answer_bytes(call.response, out.text(), "text/plain; version=0.0.4; charset=utf-8");
  call.response.set_header("Cache-Control", "no-store");
}

}  // namespace raytracer

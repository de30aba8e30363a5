// What GET /metrics tells Prometheus: the table of all families of metrics, and their values.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/engine.h"
#include "server/lru_cache.h"

namespace raytracer {

/// A counter if its name ends in _total, a histogram if it has bounds, else a gauge.
struct MetricFamily {
  std::string_view name;  ///< without the "raytracer_" that all begin with
  std::string_view help;
  std::array<std::string_view, 3> labels{};  ///< the names of as many as there are
  std::span<const double> bounds{};
};

inline constexpr std::array<double, 16> duration_bounds_s{
    0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000, 3000};
inline constexpr std::array<double, 12> ratio_bounds{0.25, 0.5,  0.7, 0.8, 0.9, 1,
                                                     1.1,  1.25, 1.5, 2,   4,   10};

inline constexpr std::array<MetricFamily, 37> metric_table{{
    {"http_requests_total",
     "Requests answered, by route and status.",
     {"method", "route", "status"}},
    {"http_request_duration_seconds",
     "From a request's header to the end of its answer, by route.",
     {"method", "route"},
     duration_bounds_s},
    {"http_requests_refused_total",
     "Requests refused: over a limit (413), no room (429), shutting down (503).",
     {"status"}},
    {"queue_duration_seconds",
     "What renders and plans waited in the queue.",
     {},
     duration_bounds_s},
    {"stage_duration_seconds", "The stages of renders.", {"stage"}, duration_bounds_s},
    {"renders_total",
     "Renders done; of a cluster's, those that this server answered or made alone."},
    {"renders_cancelled_total",
     "Renders stopped because their client left, their job was deleted, or the server ended."},
    {"renders_shared_total", "Requests that waited for another's render of the same picture."},
    {"pixels_rendered_total", "Pixels of the renders done."},
    {"samples_rendered_total", "Samples in the images of the renders done."},
    {"pixels_clamped_total",
     "Pixels of the renders done with a sample brighter than 1, which is cut off."},
    {"pixels_nan_total",
     "Pixels of the renders done with a sample that was no number: 0, or a fault here."},
    {"trace_actual_to_predicted_ratio",
     "Trace time over the time predicted, of renders whose plan was asked for before.",
     {},
     ratio_bounds},
    {"trace_predicted_seconds_total",
     "Trace time predicted, of renders whose plan was asked for before."},
    {"trace_actual_seconds_total",
     "Trace time taken by the renders whose plan was asked for before."},
    {"renders_running", "Renders and plans in an admission slot."},
    {"queue_length", "Renders and plans that wait for an admission slot."},
    {"queue_limit", "The most that may wait (--max-queue)."},
    {"jobs",
     "Jobs that are not forgotten, by status; every front of a cluster tells all of them.",
     {"status"}},
    {"event_streams_open", "Event streams about jobs."},
    {"cache_hits_total", "Look-ups that found it.", {"cache"}},
    {"cache_misses_total", "Look-ups that did not.", {"cache"}},
    {"cache_evictions_total", "What went because the memory was full.", {"cache"}},
    {"cache_entries", "What is kept now.", {"cache"}},
    {"cache_bytes", "The memory that it takes.", {"cache"}},
    {"cluster_connected", "1 while NATS can be reached and holds what is shared."},
    {"cluster_workers", "Servers of the cluster that take tasks and were heard of lately."},
    {"cluster_tasks", "Tasks of the whole cluster that wait, and that were taken.", {"state"}},
    {"cluster_redelivered_total",
     "Tasks of the whole cluster that were taken again, after whoever had them fell silent."},
    {"cluster_tasks_total", "Tasks done here."},
    {"cluster_task_failures_total", "Tasks that failed here."},
    {"cluster_task_wait_seconds",
     "What tasks that were taken here had waited.",
     {},
     duration_bounds_s},
    {"cluster_scene_bytes_total", "Bytes of scenes that were fetched for tasks."},
    {"build_info",
     "What this server is; its value is always 1.",
     {"version", "build_id", "instruction_set"}},
    {"render_threads", "Threads that trace (--threads)."},
    {"process_resident_memory_bytes", "Memory that the process holds."},
    {"process_threads", "Threads of the process."},
}};

/// A family by its name; one that is not in the table does not compile.
class MetricName {
 public:
  consteval MetricName(const char* name) {
    while (metric_table[row_].name != name) ++row_;
  }
  std::size_t row() const { return row_; }

 private:
  std::size_t row_ = 0;
};

/// Every member function may be called from any thread.
class Metrics {
 public:
  /// Of the family's labels, in their order.
  using LabelValues = std::initializer_list<std::string_view>;

  Metrics();

  /// Of a counter.
  void add(MetricName name, double amount = 1, LabelValues values = {});
  /// Of a gauge, or of a counter that is kept elsewhere.
  void set(MetricName name, double value, LabelValues values = {});
  /// Of a histogram.
  void observe(MetricName name, double value, LabelValues values = {});

  /// A part of a render's time, as Server-Timing names it.
  void took(std::string_view stage, double ms);

  /// A rendering is done. `digest` says whose, if the same scene may have been planned before.
  void rendered(const RenderReport& report, const std::optional<std::string>& digest);

  /// The trace time of a scene was predicted: rendered() compares.
  void predicted(const std::optional<std::string>& digest, const Prediction& prediction);

  /// All of them in the text format, version 0.0.4:
  /// https://prometheus.io/docs/instrumenting/exposition_formats/
  std::string text() const;

 private:
  struct Series {
    double value = 0;                      ///< a histogram's sum
    std::vector<std::uint64_t> buckets{};  ///< of each bound alone; the last of what is beyond all
  };

  /// With the mutex held.
  Series& series(std::size_t row, LabelValues values);

  mutable std::mutex mutex_;
  /// Of each family, by the values of its labels.
  std::array<std::map<std::vector<std::string>, Series>, metric_table.size()> series_;
  LruCache<double> predicted_ms_{64};  ///< of the scenes planned last, by digest; one counts 1
};

}  // namespace raytracer

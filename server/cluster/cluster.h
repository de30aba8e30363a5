// This server as a part of a cluster: what it shares and what it takes.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/cluster/cut.h"
#include "server/cluster/members.h"
#include "server/cluster/nats.h"
#include "server/cluster/news.h"
#include "server/cluster/prepared_scenes.h"
#include "server/cluster/refresher.h"
#include "server/cluster/shared_jobs.h"
#include "server/cluster/store.h"
#include "server/cluster/task_runner.h"
#include "server/config.h"
#include "server/metrics.h"
#include "server/request_log.h"
#include "server/scenes.h"

namespace raytracer {

/// Who is in it, and how many tasks there are.
struct ClusterState {
  std::vector<Member> members{};
  std::uint64_t waiting = 0;      ///< tasks
  std::uint64_t running = 0;      ///< tasks
  std::uint64_t redelivered = 0;  ///< ever
};

/// What a job is of.
struct JobScene {
  SceneView view;
  httplib::Params query;
};

/// Every member function may be called from any thread.
class Cluster {
 public:
  struct Parts {
    const Config& config;
    const std::string& renderer_id;
    const MachineCosts& machine_costs;
    std::size_t renders_at_once;
    Admission& admission;
    WorkerPool& pool;
    Scenes& scenes;
    Metrics& metrics;
    RequestLog& log;
  };

  /// All must outlive it. NATS need not be there yet. Throws ConfigError if its URL, or a file that
  /// the environment names for it, cannot be used.
  explicit Cluster(const Parts& parts);

  Jobs& jobs() { return jobs_; }

  /// Whether nothing can be shared: NATS cannot be reached, or does not hold what is shared. Waits
  /// for nothing.
  bool is_degraded() const { return !nats_.is_connected() || !store_.has_streams(); }

  /// How a render for a client that waits is shared; nothing if it is to be made here, or was
  /// stopped. Throws HttpError 503 if it is too long for this front, and nobody else is there.
  std::optional<TaskCut> choose_cut(const PreparedScene& scene, bool is_8_bit,
                                    const RenderProgress& progress);

  /// Has the cluster render it, and waits; `progress.stop` ends that. `query`: as for Jobs::accept.
  /// Throws HttpError; std::runtime_error if it failed.
  template <typename Channel>
  BasicRendering<Channel> render(const SceneView& view, const httplib::Params& query,
                                 const TaskCut& cut, RenderProgress& progress, Sharing& sharing);

  /// Throws HttpError 404, 503.
  JobScene scene_of_job(const std::string& id);

  /// Keeps a posted scene for all fronts. Throws HttpError 503.
  void keep_scene(const std::string& id, std::string_view document);
  /// What was kept by another front. Throws HttpError 503.
  std::optional<std::string> kept_scene(const std::string& id);

  /// Throws HttpError 503.
  ClusterState state();
  /// As they are now; while NATS does not answer, as they were known last.
  void set_metrics();

  /// Takes no more tasks; what runs has so long to finish, the rest is handed back.
  void drain(std::chrono::milliseconds longest);

 private:
  /// None if the render is predicted to be short.
  std::optional<TaskCut> cut_if_long(const PreparedScene& scene, bool is_8_bit,
                                     const RenderProgress& progress) const;
  Member describe_self() const;
  void look_up_metrics();
  /// That traces what tasks are of.
  WorkerPool& task_pool() { return background_ ? *background_ : parts_.pool; }

  const Parts parts_;
  const Identity self_;
  const NatsNote note_;
  NatsConnection nats_;
  ClusterStore store_;
  News news_;
  std::optional<WorkerPool> background_;  ///< of a front that works: its own renders come first
  PreparedScenes scenes_;
  std::optional<TaskRunner> runner_;
  SharedJobs jobs_;
  Heartbeat heartbeat_;
  Refresher metrics_;
};

}  // namespace raytracer

// The jobs of a cluster: any front accepts them, answers for them and, where a front has died,
// takes over what it had begun.
//
// A job is accepted once its scene and its record are stored. The front that accepted it predicts
// it; what is short it renders itself, all else it cuts into tasks. Whose front is silent is taken
// over by another, see reconciler.h.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/cluster/cut.h"
#include "server/cluster/news.h"
#include "server/cluster/prepared_scenes.h"
#include "server/cluster/reconciler.h"
#include "server/cluster/shared_job.h"
#include "server/cluster/store.h"
#include "server/cluster/task_runner.h"
#include "server/jobs.h"
#include "server/lru_cache.h"
#include "server/metrics.h"
#include "server/request_log.h"
#include "server/thread_per_task.h"

namespace raytracer {

/// Whether and how this front shares a render; nothing if it is to be made here. It may end the
/// render through its progress.
using ChooseCut = std::function<std::optional<TaskCut>(const PreparedScene&, bool is_8_bit,
                                                       const RenderProgress&)>;

class SharedJobs : public Jobs {
 public:
  struct Parts {
    Identity self;
    ClusterStore& store;
    News& news;
    PreparedScenes& scenes;
    Admission& admission;
    WorkerPool& pool;
    const Limits& limits;
    std::size_t most_open;  ///< jobs
    bool is_front;          ///< looks after jobs
    Metrics& metrics;
    RequestLog& log;
    ChooseCut choose_cut;
  };

  /// All must outlive it.
  explicit SharedJobs(Parts parts);
  ~SharedJobs() override;
  SharedJobs(const SharedJobs&) = delete;
  SharedJobs& operator=(const SharedJobs&) = delete;

  std::shared_ptr<const Job> accept(JobTask task, SceneView view, const httplib::Params& query,
                                    bool as_floats) override;
  std::shared_ptr<const Job> at(const std::string& id) override;
  void remove(const std::string& id) override;
  bool await_fetch(std::chrono::seconds) const override { return false; }
  std::map<JobStatus, std::size_t> counts() const override;

  /// Stores the record of a render for a client that waits here, and queues its tasks.
  /// Throws HttpError as accept().
  JobRecord begin_render(const SceneView& view, const httplib::Params& query, const TaskCut& cut,
                         bool is_8_bit);
  /// Nobody waits for it any more: it goes, now or once NATS is back. Throws nothing.
  void end_render(const std::string& id);

 private:
  struct Own;

  /// When to come again who is refused for what is queued in the cluster, in seconds.
  long retry_after_s() const;
  /// Throws HttpError, 429 if too much is queued and 413 if the picture can never be kept, and
  /// StreamFull if it has no room now.
  void require_room(const JobRecord& record);
  JobRecord new_record(std::string id, JobTask task, const SceneView& view,
                       const httplib::Params& query);
  void queue_all(const JobRecord& record);
  void cut_or_render(JobRecord record, const SceneView& view, Own& own);
  void render_here(JobRecord& record, const PreparedScene& scene, Own& own);
  /// Calls step() until NATS has done it, or the job is to stop; false then, or if it says false.
  bool persist(const Own& own, const std::function<bool()>& step);
  /// Has the job fail; where even that cannot be stored it is left to whoever looks after it next.
  void fail(const std::string& id, const std::string& reason, const Own& own);
  /// Does what its front, now silent, left to do.
  void take_over(JobRecord record);
  bool is_own(const std::string& id) const;
  bool is_awaited(const std::string& id) const;

  const Parts parts_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::string, Own*> own_;  ///< predicted or rendered here now
  std::set<std::string> awaited_;    ///< renders that a client waits for here
  bool closing_ = false;
  LruCache<SharedJob> watched_;
  std::shared_ptr<const void> removals_;
  ThreadPerTask threads_;
  std::optional<Reconciler> reconciler_;  ///< of a front
};

}  // namespace raytracer

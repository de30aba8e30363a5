// Takes tasks of jobs that this server's build may trace, and works on them.
//
// The job that was served longest ago comes first, so that a short one need not wait for a long
// one; those whose scene has to be fetched come a little later, so that others who have it may take
// them. Two tasks at once: one is traced while the other's result travels.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "engine/engine.h"
#include "server/cluster/news.h"
#include "server/cluster/prepared_scenes.h"
#include "server/cluster/result.h"
#include "server/cluster/store.h"
#include "server/metrics.h"
#include "server/request_log.h"

namespace raytracer {

/// Who takes tasks, and for whom.
struct Identity {
  std::string name;      ///< in the cluster, nobody else's
  std::string renderer;  ///< see renderer_id_of()
};

class TaskRunner {
 public:
  struct Parts {
    Identity self;
    ClusterStore& store;
    News& news;
    PreparedScenes& scenes;
    WorkerPool& pool;
    Metrics& metrics;
    RequestLog& log;
  };

  /// All must outlive it.
  explicit TaskRunner(const Parts& parts);
  /// Hands back what runs.
  ~TaskRunner();
  TaskRunner(const TaskRunner&) = delete;
  TaskRunner& operator=(const TaskRunner&) = delete;

  std::uint64_t tasks_done() const { return tasks_done_; }

  /// Takes no more tasks, and waits at most so long for those that run; the rest is handed back.
  void drain(std::chrono::milliseconds longest);

 private:
  using Clock = std::chrono::steady_clock;
  /// A task in work.
  struct Running {
    Running(TaskMessage task_message, std::chrono::milliseconds first_timeout)
        : message(std::move(task_message)),
          job(ClusterStore::task_of(message.subject()).first),
          task(ClusterStore::task_of(message.subject()).second),
          timeout(first_timeout) {}
    const TaskMessage message;
    const std::string job;
    const int task;
    std::chrono::milliseconds timeout;  ///< of its job: others take it when nothing is said
    bool is_whole = false;              ///< how far it is, is how far its job is
    std::atomic<bool> is_removed = false;
    RenderProgress progress{};
    double fraction_said = 0;
    Clock::time_point moved = Clock::now();  ///< when progress was last seen
  };
  using Sources = std::map<std::string, TaskSource>;

  void take_and_work();
  std::optional<TaskMessage> next_task(Sources& sources);
  /// Asks NATS what is open, unless that was a moment ago.
  void look_for_jobs();
  std::vector<OpenJob> jobs_in_order();
  void work_on(TaskMessage message);
  /// Makes and stores its result, or says why not.
  void settle(Running& running);
  /// Whether the task is to be tried here and now; settles it if not.
  bool is_to_be_tried(const JobRecord& record, Running& running);
  void make_and_store(const JobRecord& record, Running& running);
  TaskResult make(const JobRecord& record, Running& running);
  /// Leaves it to others, at no fault of the task.
  void hand_back(Running& running, std::chrono::milliseconds delay);
  /// Calls step() until NATS has done it; false if this worker ends first.
  bool persist(const std::function<void()>& step);
  void give_up(const JobRecord& record, Running& running, const std::string& reason);
  /// Within which something is to be said of all that runs.
  std::chrono::milliseconds shortest_timeout() const;
  void say_in_progress();
  void stop(const std::string& job);

  const Parts parts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closing_ = false;
  std::atomic<bool> is_handing_back_{false};
  std::list<Running> running_;
  std::vector<OpenJob> open_{};                      ///< as far as is known
  Clock::time_point looked_{};                       ///< when NATS was asked for that
  Clock::time_point changed_at_ = Clock::now();      ///< what was asked for before is out of date
  std::map<std::string, Clock::time_point> served_;  ///< or seen first
  std::atomic<std::uint64_t> tasks_done_{0};
  std::shared_ptr<const void> removals_;
  std::array<std::thread, 2> threads_;
  std::thread pulse_;
};

}  // namespace raytracer

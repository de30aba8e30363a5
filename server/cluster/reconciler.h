// Looks after all jobs of a cluster: from time to time every front goes through them. What nobody
// has cut yet and whose front is silent it takes over, tasks that have neither a result nor a
// place in the queue it queues again, and what nobody wants any more it removes.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/cluster/members.h"
#include "server/cluster/record.h"
#include "server/cluster/store.h"
#include "server/job.h"
#include "server/request_log.h"

namespace raytracer {

class Reconciler {
 public:
  struct Parts {
    std::string front;  ///< the name of this one
    ClusterStore& store;
    RequestLog& log;
    std::function<bool(const std::string& id)> is_in_work;  ///< predicted or rendered here
    std::function<bool(const std::string& id)> is_awaited;  ///< by a client, here
    std::function<void(const JobRecord&)> take_over;        ///< begins it here, if there is room
  };

  /// Begins its rounds, on a thread of its own; the destructor ends them. All must outlive it.
  explicit Reconciler(Parts parts);
  ~Reconciler();
  Reconciler(const Reconciler&) = delete;
  Reconciler& operator=(const Reconciler&) = delete;

  /// How many jobs of the cluster have each status, as of the last look at each.
  std::map<JobStatus, std::size_t> counts() const;

  /// In how many seconds the cluster's workers will have done what is queued, as of the last round,
  /// if tasks take as long as they are cut for. Jobs that are one task may take longer.
  double seconds_until_done() const { return seconds_until_done_; }

  /// Removes a job at the next round, if it is stored: its client was told that it is not.
  void remove_soon(const std::string& id);

 private:
  void go_round(const std::stop_token& end);
  void look_at_all();
  void look_at(const std::string& id, const std::vector<OpenJob>& open);
  /// Takes away what removals that were cut off left, and jobs that were refused though stored.
  void remove_leftovers(const std::vector<OpenJob>& open, const std::set<std::string>& ids);
  /// Whether tasks of the job are missing that are not queued either, now as at the last look.
  bool lost_tasks(const std::string& id, std::uint64_t queued, std::size_t missing);

  void note(const std::string& id, JobStatus status);
  void note_queue(const std::vector<OpenJob>& open, const std::vector<Member>& members);

  const Parts parts_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::set<std::string> refused_;
  std::atomic<double> seconds_until_done_{0};
  std::map<std::string, JobStatus> statuses_;  ///< of jobs that no client waits for, by ids
  // Of its thread alone:
  std::set<std::string> ended_;                 ///< need no looking after
  std::map<std::string, std::size_t> lacking_;  ///< tasks that a job lacked at the last look
  Attendance attendance_;
  std::jthread thread_;
};

}  // namespace raytracer

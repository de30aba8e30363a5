// Work that nobody holds a connection open for: accepted, watched, fetched, forgotten.
//
// A job takes its place in the same queue as every other render when it is accepted, so a full
// queue refuses both alike, and waits there on a thread of its own.
//
// Finished jobs are kept until there are too many or they take too much memory, oldest out first.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/jobs.h"
#include "server/local_job.h"
#include "server/metrics.h"
#include "server/request_log.h"
#include "server/thread_per_task.h"

namespace raytracer {

/// Every member function may be called from any thread.
class LocalJobs : public Jobs {
 public:
  /// All must outlive it.
  LocalJobs(Admission& admission, WorkerPool& pool, const Limits& limits, Metrics& metrics,
            RequestLog& log);
  /// Cancels what is not done.
  ~LocalJobs() override;
  LocalJobs(const LocalJobs&) = delete;
  LocalJobs& operator=(const LocalJobs&) = delete;

  std::shared_ptr<const Job> accept(JobTask task, SceneView view, const httplib::Params& query,
                                    bool as_floats) override;
  std::shared_ptr<const Job> at(const std::string& id) override;
  void remove(const std::string& id) override;
  bool await_fetch(std::chrono::seconds time) const override;
  std::map<JobStatus, std::size_t> counts() const override;

 private:
  void run(LocalJob& job);
  JobResult make_result(LocalJob& job);
  void keep(const std::shared_ptr<LocalJob>& job);

  Admission& admission_;
  WorkerPool& pool_;
  const Limits& limits_;
  Metrics& metrics_;
  RequestLog& log_;

  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<LocalJob>> jobs_;
  std::deque<std::shared_ptr<LocalJob>> finished_;  ///< oldest first
  std::size_t finished_bytes_ = 0;
  ThreadPerTask threads_;
};

}  // namespace raytracer

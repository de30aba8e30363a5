// The jobs of this server alone (LocalJobs), or of all fronts of a cluster (SharedJobs).
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "server/job.h"
#include "server/query.h"
#include "server/scenes.h"

namespace raytracer {

/// 128 random bits: an id cannot be guessed, and none comes twice.
std::string random_id();

/// What GET answers for a job that is not there.
[[noreturn]] void refuse_unknown_job(const std::string& id);

/// Every member function may be called from any thread, and throws HttpError 503 where what is
/// shared cannot be reached.
class Jobs {
 public:
  virtual ~Jobs() = default;

  /// Throws HttpError if the queue is full or closed. `query`: what the request said beside its
  /// document. `as_floats`: whether a render's values are to be had before rounding.
  virtual std::shared_ptr<const Job> accept(JobTask task, SceneView view,
                                            const httplib::Params& query, bool as_floats) = 0;

  /// Throws HttpError 404.
  virtual std::shared_ptr<const Job> at(const std::string& id) = 0;

  /// Cancels and forgets the job. Throws HttpError 404.
  virtual void remove(const std::string& id) = 0;

  /// Whether a job that ended at most so long ago would be lost to who has not fetched it yet.
  virtual bool await_fetch(std::chrono::seconds time) const = 0;

  /// How many of the jobs that are not forgotten have each status.
  virtual std::map<JobStatus, std::size_t> counts() const = 0;
};

}  // namespace raytracer

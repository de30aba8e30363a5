// Work that nobody holds a connection open for: accepted, watched, fetched, forgotten.
//
// A job takes its place in the same queue as every other render when it is accepted, so a full
// queue refuses both alike. As many threads run jobs as may render at once; since places are given
// in order of arrival, and these threads take jobs in that order too, none of them waits for its
// slot behind a job that has no thread yet.
//
// Finished jobs are kept until there are too many or they take too much memory, oldest out first.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/image_answer.h"
#include "server/metrics.h"
#include "server/scene_request.h"

namespace raytracer {

enum class JobStatus { queued, running, done, failed, cancelled };

inline constexpr std::array job_statuses{JobStatus::queued, JobStatus::running, JobStatus::done,
                                         JobStatus::failed, JobStatus::cancelled};

/// "queued", "running" and so on.
std::string_view name_of(JobStatus status);

/// What is made of the scene: its image, or the curve of what accuracy costs on it.
enum class JobTask { render, tradeoff };

/// "render", "tradeoff"
std::string_view name_of(JobTask task);

/// Whether it will change no more.
bool has_ended(JobStatus status);

/// What a job is like at one moment.
struct JobState {
  JobStatus status = JobStatus::queued;
  double progress = 0;    ///< 0 to 1
  double elapsed_ms = 0;  ///< since it was accepted, until it ended
  std::string detail;     ///< why it failed or was cancelled
};

/// One job. The constant members are set when it is accepted; everything else through state().
class Job {
 public:
  Job(std::string job_id, JobTask job_task, SceneRequest request);

  const std::string id;
  const JobTask task;
  const Reproducible digest;
  const double parse_ms;
  const int width;
  const int height;

  JobState state() const;

  /// Returns when the job has ended, or after `longest`.
  void wait_for_end(std::chrono::milliseconds longest) const;

  /// The rendering, once a render is done; null before.
  const Rendering* rendering() const;
  /// A render's picture as far as it has come; nothing if there is nothing to see yet, or it ended.
  std::optional<Image> image_so_far() const { return progress_.preview.so_far(); }
  /// How long it waited to be admitted.
  double queue_ms() const;
  /// Once a tradeoff is done; null before.
  const Curve* curve() const;

 private:
  friend class Jobs;
  using Clock = std::chrono::steady_clock;

  void begin();
  void end(JobStatus status, std::string detail);
  std::size_t result_bytes() const;

  std::optional<SceneRequest> request_;      ///< until it ended; only its runner reads it
  RenderProgress progress_;                  ///< of a tradeoff: of the picture that is made now
  CurveProgress curve_progress_{progress_};  ///< of a tradeoff
  std::optional<AdmissionSlot> slot_;        ///< until it ended

  mutable std::mutex mutex_;
  mutable std::condition_variable end_came_;
  JobStatus status_ = JobStatus::queued;
  std::string detail_;
  const Clock::time_point accepted_ = Clock::now();
  Clock::time_point ended_{};
  double queue_ms_ = 0;
  Rendering rendering_;  ///< written before `done`, constant from then on
  Curve curve_;          ///< the same
};

/// Every member function may be called from any thread.
class Jobs {
 public:
  /// `note` is told of exceptions.
  Jobs(Admission& admission, WorkerPool& pool, const Limits& limits, std::size_t runner_count,
       Metrics& metrics, std::function<void(std::string_view)> note);
  /// Cancels what is not done.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Throws HttpError if the queue is full or closed.
  std::shared_ptr<const Job> accept(JobTask task, SceneRequest request);

  /// Throws HttpError 404.
  std::shared_ptr<const Job> at(const std::string& id) const;

  /// Cancels and forgets the job. Throws HttpError 404.
  void remove(const std::string& id);

  /// How many of the jobs that are not forgotten have each status.
  std::map<JobStatus, std::size_t> counts() const;

 private:
  void run_jobs();
  /// Stops all jobs, and waits for the runners to end.
  void close();
  void run(Job& job);
  bool make_result(Job& job);
  void keep(const std::shared_ptr<Job>& job);

  Admission& admission_;
  WorkerPool& pool_;
  const Limits limits_;
  Metrics& metrics_;
  const std::function<void(std::string_view)> note_;

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::string, std::shared_ptr<Job>> jobs_;
  std::deque<std::shared_ptr<Job>> queue_;     ///< accepted, not yet with a runner
  std::deque<std::shared_ptr<Job>> finished_;  ///< oldest first
  std::size_t finished_bytes_ = 0;
  bool closing_ = false;
  std::vector<std::thread> runners_;
};

}  // namespace raytracer

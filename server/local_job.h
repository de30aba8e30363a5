// A job of this server.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/job.h"
#include "server/scenes.h"

namespace raytracer {

/// Everything but the request changes through the member functions alone.
class LocalJob : public Job {
 public:
  LocalJob(std::string id, JobTask task, SceneView view);

  JobState state() const override;
  void wait_for_end(std::chrono::milliseconds longest) const override;
  const JobResult* result() const override;
  std::optional<Image> image_so_far() const override { return progress_.preview.so_far(); }
  void note_fetched() const override { is_fetched_ = true; }

  /// Whether nobody was given its result, of a job that was done at most so long ago.
  bool awaits_fetch(std::chrono::seconds time) const;

 private:
  friend class LocalJobs;
  using Clock = std::chrono::steady_clock;

  void begin();
  void end(JobStatus status, std::string detail, JobResult result = {});
  std::size_t result_bytes() const;

  std::optional<SceneView> view_;            ///< until it ended; only who runs it reads it
  RenderProgress progress_;                  ///< of a tradeoff: of the picture that is made now
  CurveProgress curve_progress_{progress_};  ///< of a tradeoff
  std::optional<Admission::Slot> slot_;      ///< until it ended

  mutable std::mutex mutex_;
  mutable std::condition_variable end_came_;
  JobState state_;  ///< but for what state() computes
  const Clock::time_point accepted_ = Clock::now();
  Clock::time_point ended_{};
  JobResult result_;
  mutable std::atomic<bool> is_fetched_{false};
};

}  // namespace raytracer

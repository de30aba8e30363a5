// One piece of work that nobody holds a connection open for, as all see it who ask about it.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "engine/engine.h"
#include "server/admission.h"
#include "server/scenes.h"

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
inline bool has_ended(JobStatus status) { return status >= JobStatus::done; }

/// Nothing if it was stopped before there was any.
using JobResult = std::variant<std::monostate, Rendering, Curve>;

/// What a job is like at one moment.
struct JobState {
  JobStatus status = JobStatus::queued;
  double progress = 0;    ///< 0 to 1
  double elapsed_ms = 0;  ///< since it was accepted, until it ended
  double queue_ms = 0;    ///< how long it waited to be admitted
  std::string detail;     ///< why it failed or was cancelled
};

/// One job. The constant members are set when it is accepted; everything else through state().
class Job {
 public:
  Job(std::string job_id, JobTask job_task, SceneView view);

  const std::string id;
  const JobTask task;
  const std::optional<std::string> digest;  ///< SceneView::picture_digest()
  const double parse_ms;
  const int width;
  const int height;

  JobState state() const;

  /// Returns when the job has ended, or after `longest`.
  void wait_for_end(std::chrono::milliseconds longest) const;

  /// What came of it; null unless it is done. Constant from then on.
  const JobResult* result() const;
  /// Somebody was given its result.
  void note_fetched() const { is_fetched_ = true; }
  /// Whether nobody was, of a job that was done at most so long ago.
  bool awaits_fetch(std::chrono::seconds time) const;

  /// A render's picture as far as it has come; nothing if there is nothing to see yet, or it ended.
  std::optional<Image> image_so_far() const { return progress_.preview.so_far(); }

 private:
  friend class Jobs;
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

// One piece of work that nobody holds a connection open for, as all see it who ask about it.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "engine/engine.h"

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

/// A curve as GET /jobs/ID/result answers it.
struct CurveText {
  std::string json;
};

/// Nothing if it was stopped before there was any.
using JobResult = std::variant<std::monostate, Rendering, ByteRendering, CurveText>;

/// What a job is like at one moment.
struct JobState {
  JobStatus status = JobStatus::queued;
  double progress = 0;    ///< 0 to 1
  double elapsed_ms = 0;  ///< since it was accepted, until it ended
  double queue_ms = 0;    ///< how long it waited to be admitted
  std::string detail;     ///< why it failed or was cancelled, or what it waits for
};

/// What is known of a job from the first.
struct JobRequest {
  std::string id;
  JobTask task = JobTask::render;
  std::optional<std::string> digest{};  ///< SceneView::picture_digest()
  double parse_ms = 0;
  int width = 0;
  int height = 0;
  int channels = 3;
};

/// In how many tasks a picture was rendered, and by how many servers of which build.
struct Sharing {
  int tasks = 0;  ///< 0: it was rendered where it was asked for
  std::size_t workers = 0;
  std::string renderer{};  ///< see renderer_id_of(); empty: this server's
};

/// Every member function may be called from any thread.
class Job {
 public:
  explicit Job(JobRequest job_request) : request(std::move(job_request)) {}
  virtual ~Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const JobRequest request;

  virtual JobState state() const = 0;

  /// Returns when the job has ended, or after `longest`.
  virtual void wait_for_end(std::chrono::milliseconds longest) const = 0;

  /// What came of it; null unless it is done. Constant from then on.
  virtual const JobResult* result() const = 0;

  /// A render's picture as far as it has come; nothing if there is nothing to see yet, or it ended.
  virtual std::optional<Image> image_so_far() const = 0;

  /// Of a job that is done.
  virtual Sharing sharing() const { return {}; }

  /// Somebody was given its result.
  virtual void note_fetched() const {}
};

}  // namespace raytracer

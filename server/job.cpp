#include "server/job.h"

#include <utility>

namespace raytracer {

std::string_view name_of(JobStatus status) {
  constexpr std::array<std::string_view, job_statuses.size()> names{"queued", "running", "done",
                                                                    "failed", "cancelled"};
  return names[static_cast<std::size_t>(status)];
}

std::string_view name_of(JobTask task) { return task == JobTask::render ? "render" : "tradeoff"; }

bool has_ended(JobStatus status) {
  return status != JobStatus::queued && status != JobStatus::running;
}

Job::Job(std::string job_id, JobTask job_task, SceneView view)
    : id(std::move(job_id)),
      task(job_task),
      digest(view.picture_digest()),
      parse_ms(view.parse_ms),
      width(view.scene.camera.width),
      height(view.scene.camera.height),
      view_(std::move(view)) {}

JobState Job::state() const {
  const std::scoped_lock lock(mutex_);
  const std::chrono::duration<double, std::milli> elapsed =
      (has_ended(status_) ? ended_ : Clock::now()) - accepted_;
  const double fraction =
      task == JobTask::tradeoff ? curve_progress_.fraction() : progress_.fraction.load();
  return {status_, status_ == JobStatus::done ? 1 : fraction, elapsed.count(), queue_ms_, detail_};
}

void Job::wait_for_end(std::chrono::milliseconds longest) const {
  std::unique_lock lock(mutex_);
  end_came_.wait_for(lock, longest, [this] { return has_ended(status_); });
}

const Rendering* Job::rendering() const {
  const std::scoped_lock lock(mutex_);
  return task == JobTask::render && status_ == JobStatus::done ? &rendering_ : nullptr;
}

const Curve* Job::curve() const {
  const std::scoped_lock lock(mutex_);
  return task == JobTask::tradeoff && status_ == JobStatus::done ? &curve_ : nullptr;
}

void Job::begin() {
  const std::scoped_lock lock(mutex_);
  queue_ms_ = slot_->queue_ms();
  status_ = JobStatus::running;
}

void Job::end(JobStatus status, std::string detail) {
  {
    const std::scoped_lock lock(mutex_);
    status_ = status;
    detail_ = std::move(detail);
    ended_ = Clock::now();
  }
  end_came_.notify_all();
  view_.reset();
  slot_.reset();
}

std::size_t Job::result_bytes() const {
  const std::scoped_lock lock(mutex_);
  return rendering_.image.values.size() * sizeof(float);
}

}  // namespace raytracer

#include "server/local_job.h"

#include <utility>

namespace raytracer {

LocalJob::LocalJob(std::string id, JobTask task, SceneView view)
    : Job({.id = std::move(id),
           .task = task,
           .digest = view.picture_digest(),
           .parse_ms = view.parse_ms,
           .width = view.scene.camera.width,
           .height = view.scene.camera.height,
           .channels = channel_count(view.scene)}),
      view_(std::move(view)) {}

JobState LocalJob::state() const {
  const std::scoped_lock lock(mutex_);
  JobState state = state_;
  const std::chrono::duration<double, std::milli> elapsed =
      (has_ended(state.status) ? ended_ : Clock::now()) - accepted_;
  state.elapsed_ms = elapsed.count();
  state.progress = state.status == JobStatus::done     ? 1
                   : request.task == JobTask::tradeoff ? curve_progress_.fraction()
                                                       : progress_.fraction.load();
  return state;
}

void LocalJob::wait_for_end(std::chrono::milliseconds longest) const {
  std::unique_lock lock(mutex_);
  end_came_.wait_for(lock, longest, [this] { return has_ended(state_.status); });
}

const JobResult* LocalJob::result() const {
  const std::scoped_lock lock(mutex_);
  return state_.status == JobStatus::done ? &result_ : nullptr;
}

bool LocalJob::awaits_fetch(std::chrono::seconds time) const {
  const std::scoped_lock lock(mutex_);
  return state_.status == JobStatus::done && !is_fetched_ && Clock::now() - ended_ < time;
}

void LocalJob::begin() {
  const std::scoped_lock lock(mutex_);
  state_.queue_ms = slot_->queue_ms();
  state_.status = JobStatus::running;
}

void LocalJob::end(JobStatus status, std::string detail, JobResult result) {
  {
    const std::scoped_lock lock(mutex_);
    state_.status = status;
    state_.detail = std::move(detail);
    ended_ = Clock::now();
    result_ = std::move(result);
  }
  end_came_.notify_all();
  view_.reset();
  slot_.reset();
}

std::size_t LocalJob::result_bytes() const {
  const std::scoped_lock lock(mutex_);
  const auto* const rendering = std::get_if<Rendering>(&result_);
  return rendering ? rendering->image.values.size() * sizeof(float) : 0;
}

}  // namespace raytracer

#include "server/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "server/problem.h"
#include "server/tradeoff.h"

namespace raytracer {
namespace {

constexpr std::size_t most_finished = 1'000;            // a few kB each without their images
constexpr std::size_t most_finished_bytes = 512 << 20;  // two and a half images of 4096 x 4096

/// 128 random bits: an id cannot be guessed, and none comes twice.
std::string random_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

HttpError unknown_job(const std::string& id) {
  return HttpError({404, fmt::format("There is no job \"{}\": it never was, was deleted, or ended "
                                     "so long ago that it was forgotten",
                                     id)});
}

}  // namespace

std::string_view name_of(JobStatus status) {
  constexpr std::array<std::string_view, job_statuses.size()> names{"queued", "running", "done",
                                                                    "failed", "cancelled"};
  return names[static_cast<std::size_t>(status)];
}

std::string_view name_of(JobTask task) { return task == JobTask::render ? "render" : "tradeoff"; }

bool has_ended(JobStatus status) {
  return status != JobStatus::queued && status != JobStatus::running;
}

Job::Job(std::string job_id, JobTask job_task, SceneRequest request)
    : id(std::move(job_id)),
      task(job_task),
      digest(reproducible_digest(request)),
      parse_ms(request.parse_ms),
      width(request.scene.camera.width),
      height(request.scene.camera.height),
      request_(std::move(request)) {}

JobState Job::state() const {
  const std::scoped_lock lock(mutex_);
  const std::chrono::duration<double, std::milli> elapsed =
      (has_ended(status_) ? ended_ : Clock::now()) - accepted_;
  const double fraction =
      task == JobTask::tradeoff ? curve_progress_.fraction() : progress_.fraction.load();
  return {status_, status_ == JobStatus::done ? 1 : fraction, elapsed.count(), detail_};
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

double Job::queue_ms() const {
  const std::scoped_lock lock(mutex_);
  return queue_ms_;
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
  request_.reset();
  slot_.reset();
}

std::size_t Job::result_bytes() const {
  const std::scoped_lock lock(mutex_);
  return rendering_.image.values.size() * sizeof(float);
}

Jobs::Jobs(Admission& admission, WorkerPool& pool, const Limits& limits, std::size_t runner_count,
           Metrics& metrics, std::function<void(std::string_view)> note)
    : admission_(admission),
      pool_(pool),
      limits_(limits),
      metrics_(metrics),
      note_(std::move(note)) {
  try {
    while (runners_.size() < runner_count) runners_.emplace_back([this] { run_jobs(); });
  } catch (...) {  // the system grants no more threads
    close();
    throw;
  }
}

Jobs::~Jobs() { close(); }

void Jobs::close() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
    for (const auto& [id, job] : jobs_) job->progress_.stop = true;
  }
  arrived_.notify_all();
  for (std::thread& runner : runners_) runner.join();
}

std::shared_ptr<const Job> Jobs::accept(JobTask task, SceneRequest request) {
  const auto job = std::make_shared<Job>(random_id(), task, std::move(request));
  const std::scoped_lock lock(mutex_);  // places and jobs in one order
  job->slot_.emplace(admission_.enter(job->progress_));
  jobs_.emplace(job->id, job);
  queue_.push_back(job);
  arrived_.notify_one();
  return job;
}

std::shared_ptr<const Job> Jobs::at(const std::string& id) const {
  const std::scoped_lock lock(mutex_);
  const auto entry = jobs_.find(id);
  if (entry == jobs_.end()) throw unknown_job(id);
  return entry->second;
}

void Jobs::remove(const std::string& id) {
  std::shared_ptr<Job> job;
  {
    const std::scoped_lock lock(mutex_);
    const auto entry = jobs_.find(id);
    if (entry == jobs_.end()) throw unknown_job(id);
    job = entry->second;
    job->progress_.stop = true;
    jobs_.erase(entry);
    if (std::erase(finished_, job) > 0) finished_bytes_ -= job->result_bytes();
    if (std::erase(queue_, job) == 0) return;
  }
  // No runner has it or will: its place is free for others at once.
  job->end(JobStatus::cancelled, "deleted");
  metrics_.cancelled();
}

std::map<JobStatus, std::size_t> Jobs::counts() const {
  const std::scoped_lock lock(mutex_);
  std::map<JobStatus, std::size_t> counts;
  for (const auto& [id, job] : jobs_) ++counts[job->state().status];
  return counts;
}

void Jobs::run_jobs() {
  for (;;) {
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex_);
      arrived_.wait(lock, [&] { return closing_ || !queue_.empty(); });
      if (closing_) return;
      job = std::move(queue_.front());
      queue_.pop_front();
    }
    run(*job);
    if (job->state().status == JobStatus::cancelled) metrics_.cancelled();
    keep(job);
  }
}

/// False if it was stopped before there was one.
bool Jobs::make_result(Job& job) {
  const Scene& scene = job.request_->scene;
  if (job.task == JobTask::tradeoff) {
    std::optional<Curve> curve =
        measure_curve(scene, limits_, most_curve_ms, pool_, job.curve_progress_);
    if (!curve) return false;
    const std::scoped_lock lock(job.mutex_);
    job.curve_ = std::move(*curve);
    return true;
  }
  Rendering rendering = render(scene, limits_, pool_, job.progress_);
  if (rendering.stop == Stop::cancelled) return false;
  metrics_.rendered(rendering, job.digest);
  const std::scoped_lock lock(job.mutex_);
  job.rendering_ = std::move(rendering);
  return true;
}

void Jobs::run(Job& job) {
  try {
    if (!job.slot_->wait_until_admitted()) return job.end(JobStatus::cancelled, "stopped");
    job.begin();
    metrics_.waited(job.queue_ms());
    if (!make_result(job)) return job.end(JobStatus::cancelled, "stopped");
    job.end(JobStatus::done, "");
  } catch (const HttpError& refusal) {
    job.end(JobStatus::cancelled, refusal.problem().detail);
  } catch (const std::exception& error) {
    note_(fmt::format("job {} failed: {}", job.id, error.what()));
    job.end(JobStatus::failed, "The render failed inside the server; its log says why");
  }
}

void Jobs::keep(const std::shared_ptr<Job>& job) {
  const std::scoped_lock lock(mutex_);
  if (!jobs_.contains(job->id)) return;  // removed meanwhile
  finished_.push_back(job);
  finished_bytes_ += job->result_bytes();
  while (finished_.size() > 1 &&
         (finished_.size() > most_finished || finished_bytes_ > most_finished_bytes)) {
    finished_bytes_ -= finished_.front()->result_bytes();
    jobs_.erase(finished_.front()->id);
    finished_.pop_front();
  }
}

}  // namespace raytracer

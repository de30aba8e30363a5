#include "server/local_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "server/problem.h"
#include "server/tradeoff.h"

namespace raytracer {
namespace {

constexpr std::size_t most_finished = 1'000;            // a few kB each without their images
constexpr std::size_t most_finished_bytes = 512 << 20;  // two and a half images of 4096 x 4096

}  // namespace

LocalJobs::LocalJobs(Admission& admission, WorkerPool& pool, const Limits& limits, Metrics& metrics,
                     RequestLog& log)
    : admission_(admission),
      pool_(pool),
      limits_(limits),
      metrics_(metrics),
      log_(log),
      threads_(std::numeric_limits<std::size_t>::max()) {}  // admission bounds them

LocalJobs::~LocalJobs() {
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [id, job] : jobs_) admission_.stop(job->progress_);
  }
  threads_.shutdown();
}

std::shared_ptr<const Job> LocalJobs::accept(JobTask task, SceneView view,
                                             const httplib::Params& /*query*/, bool /*as_floats*/) {
  const auto job = std::make_shared<LocalJob>(random_id(), task, std::move(view));
  job->slot_.emplace(admission_, job->progress_);
  const std::scoped_lock lock(mutex_);  // it is kept only once it is among the jobs
  threads_.enqueue([this, job] {
    run(*job);
    keep(job);
  });
  jobs_.emplace(job->request.id, job);
  return job;
}

std::shared_ptr<const Job> LocalJobs::at(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  const auto entry = jobs_.find(id);
  if (entry == jobs_.end()) refuse_unknown_job(id);
  return entry->second;
}

void LocalJobs::remove(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  const auto entry = jobs_.find(id);
  if (entry == jobs_.end()) refuse_unknown_job(id);
  admission_.stop(entry->second->progress_);
  if (std::erase(finished_, entry->second) > 0) finished_bytes_ -= entry->second->result_bytes();
  jobs_.erase(entry);
}

bool LocalJobs::await_fetch(std::chrono::seconds time) const {
  const std::scoped_lock lock(mutex_);
  return std::any_of(jobs_.begin(), jobs_.end(),
                     [&](const auto& entry) { return entry.second->awaits_fetch(time); });
}

std::map<JobStatus, std::size_t> LocalJobs::counts() const {
  const std::scoped_lock lock(mutex_);
  std::map<JobStatus, std::size_t> counts;
  for (const auto& [id, job] : jobs_) ++counts[job->state().status];
  return counts;
}

void LocalJobs::run(LocalJob& job) {
  try {
    JobResult result;
    if (job.slot_->wait_until_admitted()) result = make_result(job);
    const bool is_done = result.index() != 0;
    if (!is_done) metrics_.add("renders_cancelled_total");
    job.end(is_done ? JobStatus::done : JobStatus::cancelled, is_done ? "" : "stopped",
            std::move(result));
  } catch (const HttpError& refusal) {
    metrics_.add("renders_cancelled_total");
    job.end(JobStatus::cancelled, refusal.problem().detail);
  } catch (const std::exception& error) {
    log_.note(fmt::format("job {} failed: {}", job.request.id, error.what()));
    job.end(JobStatus::failed, "The render failed inside the server; its log says why");
  }
}

JobResult LocalJobs::make_result(LocalJob& job) {
  job.begin();
  metrics_.observe("queue_duration_seconds", job.slot_->queue_ms() / 1000);
  const Scene& scene = job.view_->scene;
  if (job.request.task == JobTask::tradeoff) {
    std::optional<Curve> curve =
        measure_curve(scene, limits_, most_curve_ms, pool_, job.curve_progress_);
    return curve ? JobResult(text_of(*curve)) : JobResult();
  }
  Rendering rendering = render(scene, limits_, pool_, job.progress_);
  if (rendering.stop == Stop::cancelled) return {};
  metrics_.rendered(rendering, job.request.digest);
  return rendering;
}

void LocalJobs::keep(const std::shared_ptr<LocalJob>& job) {
  const std::scoped_lock lock(mutex_);
  if (!jobs_.contains(job->request.id)) return;  // removed meanwhile
  finished_.push_back(job);
  finished_bytes_ += job->result_bytes();
  while (finished_.size() > 1 &&
         (finished_.size() > most_finished || finished_bytes_ > most_finished_bytes)) {
    finished_bytes_ -= finished_.front()->result_bytes();
    jobs_.erase(finished_.front()->request.id);
    finished_.pop_front();
  }
}

}  // namespace raytracer

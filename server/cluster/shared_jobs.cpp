#include "server/cluster/shared_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "server/cluster/answered.h"
#include "server/cluster/result.h"
#include "server/problem.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t most_watched_bytes = 512 << 20;
constexpr milliseconds before_another_call{250};

/// What it takes to watch a job: its picture.
std::size_t bytes_of(const JobRecord& record) {
  const std::size_t value_bytes = record.is_8_bit ? sizeof(unsigned char) : sizeof(float);
  return sizeof(SharedJob) + value_bytes * static_cast<std::size_t>(record.channels) *
                                 static_cast<std::size_t>(record.width) *
                                 static_cast<std::size_t>(record.height);
}

/// Whether the picture in 8 bits says the same of its error as one in floats: by its samples, not
/// by its pixels.
bool tells_error_in_8_bit(const SceneView& view) {
  return !needs_floats(view.scene) && samples_tell_error(view.scene.render.samples.value_or(1));
}

/// Notes in the job how it is cut.
void note_cut(JobRecord& record, const TaskCut& cut) {
  record.predicted_ms = cut.predicted_ms;
  record.plan_ms = cut.plan_ms;
  record.build_ms = cut.build_ms;
  record.side_px = cut.side_px;
  record.task_count = cut.task_count;
}

}  // namespace

/// A job that this front predicts or renders, and has in work as long as this lives.
struct SharedJobs::Own {
  /// Throws HttpError as Admission::Slot.
  Own(SharedJobs& shared_jobs, std::string job)
      : jobs(shared_jobs), id(std::move(job)), slot(jobs.parts_.admission, progress) {
    const std::scoped_lock lock(jobs.mutex_);
    if (jobs.closing_) progress.stop = true;
    jobs.own_.emplace(id, this);
  }
  ~Own() {
    const std::scoped_lock lock(jobs.mutex_);
    jobs.own_.erase(id);
  }
  Own(const Own&) = delete;
  Own& operator=(const Own&) = delete;

  SharedJobs& jobs;
  const std::string id;
  RenderProgress progress;
  Admission::Slot slot;
};

SharedJobs::SharedJobs(Parts parts)
    : parts_(std::move(parts)),
      watched_(most_watched_bytes),
      removals_(parts_.store.listen_for_removals([this](const std::string& id) {
        const std::scoped_lock lock(mutex_);
        if (const auto own = own_.find(id); own != own_.end())
          parts_.admission.stop(own->second->progress);
      })),
      threads_(std::numeric_limits<std::size_t>::max()) {  // admission bounds them
  if (!parts_.is_front) return;
  reconciler_.emplace(Reconciler::Parts{
      .front = parts_.self.name,
      .store = parts_.store,
      .log = parts_.log,
      .is_in_work = [this](const std::string& id) { return is_own(id); },
      .is_awaited = [this](const std::string& id) { return is_awaited(id); },
      .take_over = [this](const JobRecord& record) { take_over(record); },
  });
}

SharedJobs::~SharedJobs() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
    for (const auto& [id, own] : own_) parts_.admission.stop(own->progress);
  }
  changed_.notify_all();
  reconciler_.reset();
  threads_.shutdown();
}

long SharedJobs::retry_after_s() const {
  const double queued_s = reconciler_ ? std::ceil(reconciler_->seconds_until_done()) : 0;
  return std::max(parts_.admission.retry_after_s(),
                  std::lround(std::min(queued_s, longest_retry_after_s)));
}

void SharedJobs::require_room(const JobRecord& record) {
  parts_.store.require_streams();
  if (parts_.store.open_job_count() >= parts_.most_open)
    refuse(429, "The queue of the cluster is full; try again later",
           {{"Retry-After", std::to_string(retry_after_s())}});
  if (record.task == JobTask::tradeoff) return;  // a few kilobytes
  // Whole results are floats, whatever they are shown in.
  const std::uint64_t bytes = sizeof(float) * static_cast<std::uint64_t>(record.channels) *
                              static_cast<std::uint64_t>(record.width) *
                              static_cast<std::uint64_t>(record.height);
  const StreamFill fill = parts_.store.fill_of_results();
  if (bytes > fill.most_bytes)
    refuse(413, fmt::format("The picture takes {} bytes, but the cluster keeps {} of all results "
                            "(half of --max-stored)",
                            bytes, fill.most_bytes));
  if (fill.bytes + bytes > fill.most_bytes)
    throw StreamFull(fmt::format(
        "the cluster's store is full: results have {} of {} bytes, and this picture may take {}: "
        "delete jobs, wait until they are forgotten (--keep), or give it more (--max-stored)",
        fill.bytes, fill.most_bytes, bytes));
}

JobRecord SharedJobs::new_record(std::string id, JobTask task, const SceneView& view,
                                 const httplib::Params& query) {
  if (!view.document) throw std::logic_error("a scene without its text cannot be shared");
  JobRecord record{
      .id = std::move(id),
      .task = task,
      .document = ClusterStore::digest_of(*view.document),
      .query = {query.begin(), query.end()},
      .renderer = parts_.self.renderer,
      .front = parts_.self.name,
      .picture_digest = view.picture_digest(),
      .parse_ms = view.parse_ms,
      .limits = parts_.limits,
      .task_timeout_s = std::chrono::duration<double>(parts_.store.limits().task_timeout).count(),
      .width = view.scene.camera.width,
      .height = view.scene.camera.height,
      .channels = channel_count(view.scene),
      .samples = view.scene.render.samples.value_or(1),
      .accepted_ms = now_ms()};
  record.query.erase("task");
  return record;
}

std::shared_ptr<const Job> SharedJobs::accept(JobTask task, SceneView view,
                                              const httplib::Params& query, bool as_floats) {
  return answered([&] {
    const auto own = std::make_shared<Own>(*this, random_id());
    JobRecord record = new_record(own->id, task, view, query);
    record.is_8_bit = task == JobTask::render && !as_floats && tells_error_in_8_bit(view);
    require_room(record);
    try {
      parts_.store.put_job(record);
      parts_.store.put_document(record.document, *view.document);
      const auto job = std::make_shared<const SharedJob>(record, parts_.store, parts_.news);
      watched_.keep(record.id, job, bytes_of(record));
      threads_.enqueue([this, record, view = std::move(view), own]() mutable {
        cut_or_render(std::move(record), view, *own);
      });
      return std::shared_ptr<const Job>(job);
    } catch (...) {
      if (reconciler_) reconciler_->remove_soon(own->id);
      throw;
    }
  });
}

JobRecord SharedJobs::begin_render(const SceneView& view, const httplib::Params& query,
                                   const TaskCut& cut, bool is_8_bit) {
  return answered([&] {
    JobRecord record = new_record(random_id(), JobTask::render, view, query);
    record.has_client = true;
    record.is_8_bit = is_8_bit;
    require_room(record);
    {
      const std::scoped_lock lock(mutex_);
      awaited_.insert(record.id);
    }
    try {
      parts_.store.put_job(record);
      parts_.store.put_document(record.document, *view.document);
      note_cut(record, cut);  // with tasks in it, others would queue them
      parts_.store.put_job(record);
      queue_all(record);
    } catch (...) {
      end_render(record.id);
      throw;
    }
    return record;
  });
}

void SharedJobs::end_render(const std::string& id) {
  {
    const std::scoped_lock lock(mutex_);
    awaited_.erase(id);
  }
  try {
    parts_.store.remove_job(id);
  } catch (const std::exception&) {  // NOLINT: the reconciler does it later
  }
}

void SharedJobs::queue_all(const JobRecord& record) {
  std::vector<int> tasks(static_cast<std::size_t>(record.task_count));
  std::iota(tasks.begin(), tasks.end(), 0);
  parts_.store.queue_tasks(record, tasks);
}

std::shared_ptr<const Job> SharedJobs::at(const std::string& id) {
  return answered([&] {
    const auto record = parts_.store.job(id);
    if (!record || record->has_client) refuse_unknown_job(id);
    std::shared_ptr<const SharedJob> job = watched_.find(id);
    if (job) {
      job->look_again();
      return std::shared_ptr<const Job>(job);
    }
    job = std::make_shared<const SharedJob>(*record, parts_.store, parts_.news);
    watched_.keep(id, job, bytes_of(*record));
    return std::shared_ptr<const Job>(job);
  });
}

void SharedJobs::remove(const std::string& id) {
  answered([&] {
    const auto record = parts_.store.job(id);
    if (!record) refuse_unknown_job(id);
    const bool is_open = parts_.store.is_open(*record);
    parts_.store.remove_job(id);
    if (is_open) parts_.metrics.add("renders_cancelled_total");
  });
}

std::map<JobStatus, std::size_t> SharedJobs::counts() const {
  return reconciler_ ? reconciler_->counts() : std::map<JobStatus, std::size_t>();
}

bool SharedJobs::persist(const Own& own, const std::function<bool()>& step) {
  while (true) {
    try {
      return step();
    } catch (const NatsUnavailable&) {  // NOLINT: it comes back
    }
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, before_another_call,
                          [&] { return closing_ || own.progress.stop.load(); }))
      return false;
  }
}

void SharedJobs::fail(const std::string& id, const std::string& reason, const Own& own) {
  parts_.log.note(fmt::format("job {} failed: {}", id, reason));
  try {
    persist(own, [&] {
      parts_.store.fail_job(id, reason);
      return true;
    });
  } catch (const std::exception& error) {
    parts_.log.note(fmt::format("job {}: that cannot be stored: {}", id, error.what()));
  }
}

void SharedJobs::cut_or_render(JobRecord record, const SceneView& view, Own& own) {
  try {
    // A front that shuts down leaves it to the others.
    if (own.slot.wait_until_admitted()) {
      record.queue_ms = own.slot.queue_ms();
      parts_.metrics.observe("queue_duration_seconds", record.queue_ms / 1000);
      if (record.task == JobTask::tradeoff) {
        record.task_count = 1;
      } else {
        const PreparedScene scene(view.scene, parts_.pool);
        if (const auto cut = parts_.choose_cut(scene, record.is_8_bit, own.progress)) {
          note_cut(record, *cut);
        } else if (!own.progress.stop) {
          render_here(record, scene, own);
        }
      }
      const bool is_to_be_queued = record.task_count > 0 && !own.progress.stop;
      if (is_to_be_queued && persist(own, [&] { return parts_.store.put_job(record); }))
        persist(own, [&] {
          if (!parts_.store.results(record.id).empty()) return true;  // it was rendered here
          queue_all(record);
          return true;
        });
    }
  } catch (const HttpError&) {  // NOLINT: the same: this front shuts down
  } catch (const std::exception& error) {
    fail(record.id, fmt::format("The render failed inside the server: {}", error.what()), own);
  }
}

void SharedJobs::render_here(JobRecord& record, const PreparedScene& scene, Own& own) {
  Rendering rendering = render(scene, record.limits, parts_.pool, own.progress);
  if (rendering.stop == Stop::cancelled) return;
  parts_.metrics.rendered(rendering, record.picture_digest);
  const std::string bytes = to_bytes(TaskResult{parts_.self.name, std::move(rendering)});
  if (persist(own, [&] {
        parts_.store.put_result(record.id, 0, bytes);
        return true;
      }))
    record.task_count = 1;
}

bool SharedJobs::is_own(const std::string& id) const {
  const std::scoped_lock lock(mutex_);
  return own_.contains(id);
}

bool SharedJobs::is_awaited(const std::string& id) const {
  const std::scoped_lock lock(mutex_);
  return awaited_.contains(id);
}

void SharedJobs::take_over(JobRecord record) {
  std::shared_ptr<Own> own;
  try {
    own = std::make_shared<Own>(*this, record.id);
  } catch (const HttpError&) {
    return;  // no room here now
  }
  if (own->progress.stop) return;  // this front shuts down
  parts_.log.note(fmt::format("job {} is taken over from {}", record.id, record.front));
  threads_.enqueue([this, record, own]() mutable {
    try {
      record.front = parts_.self.name;
      // Who had it may have rendered it, and died before it could say so.
      if (parts_.store.has_result(record.id, 0))
        record.task_count = 1;
      else
        record.renderer = parts_.self.renderer;
      if (persist(*own, [&] { return parts_.store.put_job(record); }) && record.task_count == 0) {
        const SceneView view = parts_.scenes.view_of(record);
        cut_or_render(std::move(record), view, *own);
      }
    } catch (const NatsUnavailable&) {  // NOLINT: it is tried again
    } catch (const std::exception& error) {
      fail(record.id, error.what(), *own);
    }
  });
}

}  // namespace raytracer

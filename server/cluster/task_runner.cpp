#include "server/cluster/task_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "server/cluster/members.h"
#include "server/problem.h"
#include "server/tradeoff.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds between_searches{250};  // for tasks that come again
constexpr milliseconds to_answer{100};
constexpr milliseconds before_another_worker{500};
constexpr milliseconds before_asking_again{250};  // NATS, while it is away
constexpr milliseconds to_fetch_scene{500};       // that others have: a task or two
constexpr seconds longest_standstill{30};         // of a task that is still said to be in progress
constexpr std::size_t most_failures = 3;
/// Workers that a task may outlive: to die beside a task is not to die of it.
constexpr std::size_t most_losses = 5;

}  // namespace

TaskRunner::TaskRunner(const Parts& parts)
    : parts_(parts),
      removals_(parts.store.listen_for_removals([this](const std::string& job) { stop(job); })) {
  for (std::thread& thread : threads_) thread = std::thread([this] { take_and_work(); });
  pulse_ = std::thread([this] { say_in_progress(); });
}

TaskRunner::~TaskRunner() { drain(milliseconds(0)); }

void TaskRunner::drain(milliseconds longest) {
  {
    std::unique_lock lock(mutex_);
    closing_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, longest, [this] { return running_.empty(); });
    is_handing_back_ = true;
    for (Running& running : running_) running.progress.stop = true;
  }
  changed_.notify_all();
  parts_.news.tell();
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
  if (pulse_.joinable()) pulse_.join();
}

void TaskRunner::take_and_work() {
  Sources sources;
  std::uint64_t seen = 0;
  while (true) {
    {
      const std::scoped_lock lock(mutex_);
      if (closing_) return;
    }
    try {
      if (std::optional<TaskMessage> task = next_task(sources)) {
        work_on(*std::move(task));
        continue;
      }
    } catch (const NatsUnavailable&) {
      sources.clear();
    } catch (const std::exception& error) {
      parts_.log.note(fmt::format("tasks cannot be taken: {}", error.what()));
      sources.clear();
    }
    parts_.news.wait(seen, between_searches);
    const std::scoped_lock lock(mutex_);
    changed_at_ = Clock::now();  // whatever happened, it is to be looked at
  }
}

void TaskRunner::look_for_jobs() {
  constexpr seconds recently{1};
  const auto asked = Clock::now();
  {
    const std::scoped_lock lock(mutex_);
    if (looked_ > changed_at_ && asked - looked_ <= recently) return;
  }
  // Without the lock: NATS may take seconds, and meanwhile all that runs is to be heard of.
  std::vector<OpenJob> open = parts_.store.open_jobs();
  std::erase_if(open, [this](const OpenJob& job) { return job.renderer != parts_.self.renderer; });
  const std::scoped_lock lock(mutex_);
  if (asked < looked_) return;  // another thread has asked later
  open_ = std::move(open);
  looked_ = asked;
  std::erase_if(served_, [this](const auto& entry) {
    return std::none_of(open_.begin(), open_.end(),
                        [&](const OpenJob& job) { return job.id == entry.first; });
  });
}

std::vector<OpenJob> TaskRunner::jobs_in_order() {
  look_for_jobs();
  struct Due {
    Clock::time_point at;
    OpenJob job;
  };
  std::vector<Due> due;
  {
    const std::scoped_lock lock(mutex_);
    for (const OpenJob& job : open_) {
      const auto served = served_.try_emplace(job.id, Clock::now()).first->second;
      due.push_back({parts_.scenes.has(job.document) ? served : served + to_fetch_scene, job});
    }
  }
  std::stable_sort(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.at < b.at; });
  std::vector<OpenJob> jobs;
  jobs.reserve(due.size());
  for (Due& one : due) jobs.push_back(std::move(one.job));
  return jobs;
}

std::optional<TaskMessage> TaskRunner::next_task(Sources& sources) {
  const std::vector<OpenJob> jobs = jobs_in_order();
  // One that is kept may hold a task that came when nobody waited any more.
  std::erase_if(sources, [&](const auto& entry) {
    return std::none_of(jobs.begin(), jobs.end(),
                        [&](const OpenJob& job) { return job.id == entry.first; });
  });
  for (const OpenJob& job : jobs) {
    if (job.waiting + job.running == 0) continue;
    auto source = sources.find(job.id);
    try {
      if (source == sources.end())
        source = sources.emplace(job.id, parts_.store.tasks_of(job)).first;
      std::optional<TaskMessage> task = source->second.take(to_answer);
      const std::scoped_lock lock(mutex_);
      if (!task) {
        // Others had them; what they do not finish comes again.
        for (OpenJob& known : open_)
          if (known.id == job.id) known.waiting = known.running = 0;
        continue;
      }
      served_[job.id] = Clock::now();
      return task;
    } catch (const NatsRefused&) {
      sources.erase(job.id);  // it was removed
      const std::scoped_lock lock(mutex_);
      changed_at_ = Clock::now();
    }
  }
  return {};
}

void TaskRunner::work_on(TaskMessage message) {
  std::list<Running>::iterator running;
  {
    const std::scoped_lock lock(mutex_);
    running =
        running_.emplace(running_.end(), std::move(message), parts_.store.limits().task_timeout);
    if (is_handing_back_) running->progress.stop = true;
  }
  struct AtEnd {
    TaskRunner& runner;
    const std::list<Running>::iterator running;
    ~AtEnd() {
      const std::scoped_lock lock(runner.mutex_);
      runner.running_.erase(running);
      runner.changed_.notify_all();
    }
  } const at_end{*this, running};
  const auto note = [&](const std::exception& error) {
    parts_.log.note(
        fmt::format("job {} task {} was left: {}", running->job, running->task, error.what()));
  };
  try {
    settle(*running);
  } catch (const NatsUnavailable& error) {
    note(error);
    persist([&] { hand_back(*running, milliseconds(0)); });  // it is not lost with its worker
  } catch (const std::exception& error) {
    note(error);  // it comes again when its time is over
  }
}

void TaskRunner::settle(Running& running) {
  const std::optional<JobRecord> record = parts_.store.job(running.job);
  if (!record || !record->failure.empty())
    return running.message.acknowledge();  // nobody wants it any more
  {
    const std::scoped_lock lock(mutex_);
    running.timeout = record->task_timeout();
    running.is_whole = record->is_whole();
    changed_.notify_all();
  }
  if (!is_to_be_tried(*record, running)) return;
  try {
    make_and_store(*record, running);
  } catch (const NatsUnavailable&) {
    throw;
  } catch (const StreamFull& error) {
    parts_.log.note(fmt::format("job {} failed: {}", running.job, error.what()));
    parts_.store.fail_job(running.job, error.what(), true);  // so it is for others
    running.message.acknowledge();
  } catch (const std::exception& error) {
    give_up(*record, running, error.what());
  }
}

void TaskRunner::make_and_store(const JobRecord& record, Running& running) {
  const TaskResult result = make(record, running);
  if (running.progress.stop) {
    if (!running.is_removed) return hand_back(running, milliseconds(0));
    return running.message.acknowledge();
  }
  const std::string bytes = to_bytes(result);
  if (!persist([&] { parts_.store.put_result(running.job, running.task, bytes); }))
    throw NatsUnavailable("ended");
  running.message.acknowledge();
  ++tasks_done_;
  parts_.metrics.add("cluster_tasks_total");
}

bool TaskRunner::is_to_be_tried(const JobRecord& record, Running& running) {
  const std::uint64_t before = running.message.deliveries() - 1;
  if (before == 0) {
    const auto waited = static_cast<double>(now_ms() - running.message.queued_ms());
    parts_.metrics.observe("cluster_task_wait_seconds", std::max(waited, 0.0) / 1000);
    return true;
  }
  parts_.store.note_redelivery(record.id, running.task);
  if (parts_.store.has_result(record.id, running.task)) {
    running.message.acknowledge();  // who had it was only late
    return false;
  }
  const std::vector<TaskFailure> failures = parts_.store.failures(record.id, running.task);
  const std::size_t told = failures.size() + parts_.store.hand_backs(record.id, running.task);
  if (before >= told + most_losses) {
    parts_.store.fail_job(record.id,
                          fmt::format("Task {} was lost {} times with the worker that had "
                                      "taken it",
                                      running.task, before - told));
    running.message.acknowledge();
    return false;
  }
  // Another may do what failed here.
  const bool failed_here = std::any_of(failures.begin(), failures.end(), [&](const auto& failure) {
    return failure.worker == parts_.self.name;
  });
  if (!failed_here) return true;
  for (const Member& member : parts_.store.members())
    if (member.works && member.renderer == parts_.self.renderer &&
        member.name != parts_.self.name && is_alive(member, parts_.store.limits()) &&
        std::none_of(failures.begin(), failures.end(),
                     [&](const auto& failure) { return failure.worker == member.name; })) {
      hand_back(running, before_another_worker);
      return false;
    }
  return true;
}

void TaskRunner::hand_back(Running& running, milliseconds delay) {
  parts_.store.note_hand_back(running.job, running.task, running.message.deliveries());
  running.message.hand_back(delay);
}

bool TaskRunner::persist(const std::function<void()>& step) {
  while (true) {
    try {
      step();
      return true;
    } catch (const NatsUnavailable&) {  // NOLINT: it comes back
    }
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, before_asking_again, [this] { return is_handing_back_.load(); }))
      return false;
  }
}

TaskResult TaskRunner::make(const JobRecord& record, Running& running) {
  if (record.task == JobTask::tradeoff) {
    const SceneView view = parts_.scenes.view_of(record);
    CurveProgress progress{running.progress};
    std::optional<Curve> curve =
        measure_curve(view.scene, record.limits, most_curve_ms, parts_.pool, progress);
    return {parts_.self.name, curve ? text_of(*curve) : CurveText{}};
  }
  const std::shared_ptr<const PreparedView> scene = parts_.scenes.prepare(record);
  if (record.is_whole())
    return {parts_.self.name,
            render(scene->prepared, record.limits, parts_.pool, running.progress)};
  const std::vector<Tile> regions = regions_of(record.width, record.height, record.side_px);
  const Tile& region = regions.at(static_cast<std::size_t>(running.task));
  const auto made = [&]<typename Channel>(std::optional<RegionRendering<Channel>> part) {
    return TaskResult{parts_.self.name, part ? *std::move(part) : RegionRendering<Channel>{}};
  };
  if (record.is_8_bit)
    return made(
        render_region<unsigned char>(scene->prepared, region, parts_.pool, running.progress));
  return made(render_region<float>(scene->prepared, region, parts_.pool, running.progress));
}

void TaskRunner::give_up(const JobRecord& record, Running& running, const std::string& reason) {
  parts_.log.note(fmt::format("job {} task {} failed: {}", record.id, running.task, reason));
  parts_.metrics.add("cluster_task_failures_total");
  const std::vector<TaskFailure> before = parts_.store.failures(record.id, running.task);
  parts_.store.add_failure(record.id, running.task, before.size(), {parts_.self.name, reason});
  if (before.size() + 1 >= most_failures) {
    parts_.store.fail_job(record.id, fmt::format("Task {} failed {} times, the last time so: {}",
                                                 running.task, before.size() + 1, reason));
    running.message.acknowledge();
    return;
  }
  running.message.hand_back(before_another_worker);
}

milliseconds TaskRunner::shortest_timeout() const {
  milliseconds shortest = parts_.store.limits().task_timeout;
  for (const Running& running : running_) shortest = std::min(shortest, running.timeout);
  return shortest;
}

void TaskRunner::say_in_progress() {
  std::unique_lock lock(mutex_);
  while (!is_handing_back_) {
    const milliseconds timeout = shortest_timeout();
    changed_.wait_for(lock, timeout / 4,
                      [&] { return is_handing_back_ || shortest_timeout() < timeout; });
    std::vector<std::pair<std::string, double>> said;  // NATS is asked without the lock
    for (Running& running : running_) {
      const double fraction = running.progress.fraction;
      if (fraction != running.fraction_said) running.moved = Clock::now();
      running.fraction_said = fraction;
      if (Clock::now() - running.moved > longest_standstill) continue;
      running.message.say_in_progress();
      if (running.is_whole) said.emplace_back(running.job, fraction);
    }
    if (closing_ && running_.empty()) return;
    lock.unlock();
    for (const auto& [job, fraction] : said) {
      try {
        parts_.store.put_progress(job, fraction);
      } catch (const std::exception&) {  // NOLINT: it is said again
      }
    }
    lock.lock();
  }
}

void TaskRunner::stop(const std::string& job) {
  const std::scoped_lock lock(mutex_);
  for (Running& running : running_)
    if (running.job == job) {
      running.is_removed = true;
      running.progress.stop = true;
    }
}

}  // namespace raytracer

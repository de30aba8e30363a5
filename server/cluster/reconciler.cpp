#include "server/cluster/reconciler.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "server/cluster/cut.h"
#include "server/cluster/nats.h"

namespace raytracer {
namespace {

constexpr std::chrono::milliseconds between_rounds{500};

/// Tasks of a job that wait or run.
std::uint64_t queued_tasks(const std::vector<OpenJob>& open, const std::string& id) {
  const auto job =
      std::find_if(open.begin(), open.end(), [&](const OpenJob& one) { return one.id == id; });
  return job == open.end() ? 0 : job->waiting + job->running;
}

std::vector<int> missing_tasks(int count, const std::set<int>& done) {
  std::vector<int> tasks;
  for (int task = 0; task < count; ++task)
    if (!done.contains(task)) tasks.push_back(task);
  return tasks;
}

}  // namespace

Reconciler::Reconciler(Parts parts)
    : parts_(std::move(parts)),
      attendance_(parts_.store.limits().task_timeout),
      thread_([this](const std::stop_token& end) { go_round(end); }) {}

Reconciler::~Reconciler() = default;  // the thread is told to end, and waited for

void Reconciler::remove_soon(const std::string& id) {
  const std::scoped_lock lock(mutex_);
  refused_.insert(id);
}

std::map<JobStatus, std::size_t> Reconciler::counts() const {
  const std::scoped_lock lock(mutex_);
  std::map<JobStatus, std::size_t> counts;
  for (const auto& [id, status] : statuses_) ++counts[status];
  return counts;
}

void Reconciler::note(const std::string& id, JobStatus status) {
  const std::scoped_lock lock(mutex_);
  statuses_[id] = status;
}

void Reconciler::go_round(const std::stop_token& end) {
  while (!end.stop_requested()) {
    try {
      look_at_all();
    } catch (const NatsUnavailable&) {  // it comes back
      attendance_.interrupt();
    } catch (const std::exception& error) {
      parts_.log.note(fmt::format("jobs cannot be looked after: {}", error.what()));
    }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, end, between_rounds, [] { return false; });
  }
}

void Reconciler::look_at_all() {
  // In this order: whatever has a consumer had a record before.
  const std::vector<OpenJob> open = parts_.store.open_jobs();
  const std::vector<std::string> listed = parts_.store.job_ids();
  const std::set<std::string> ids(listed.begin(), listed.end());
  remove_leftovers(open, ids);
  std::erase_if(ended_, [&](const std::string& id) { return !ids.contains(id); });
  std::erase_if(lacking_, [&](const auto& entry) { return !ids.contains(entry.first); });
  {
    const std::scoped_lock lock(mutex_);
    std::erase_if(statuses_, [&](const auto& entry) { return !ids.contains(entry.first); });
  }
  for (const std::string& id : ids)
    if (parts_.is_in_work(id)) note(id, JobStatus::running);
  std::vector<std::string> in_question;
  std::copy_if(ids.begin(), ids.end(), std::back_inserter(in_question),
               [&](const auto& id) { return !ended_.contains(id) && !parts_.is_in_work(id); });
  if (in_question.empty()) {
    seconds_until_done_ = 0;
    return;
  }
  const std::vector<Member> members = parts_.store.members();
  attendance_.look(members);
  note_queue(open, members);
  for (const std::string& id : in_question) {
    try {
      look_at(id, open);
    } catch (const UnreadableRecord& error) {
      parts_.log.note(fmt::format("job {} is left to others: {}", id, error.what()));
      ended_.insert(id);
    }
  }
}

void Reconciler::note_queue(const std::vector<OpenJob>& open, const std::vector<Member>& members) {
  std::uint64_t tasks = 0;
  for (const OpenJob& job : open) tasks += job.waiting + job.running;
  std::size_t threads = 0;
  for (const Member& member : members)
    if (member.works && is_alive(member, parts_.store.limits())) threads += member.threads;
  seconds_until_done_ =
      static_cast<double>(tasks) * task_s / static_cast<double>(std::max<std::size_t>(threads, 1));
}

void Reconciler::remove_leftovers(const std::vector<OpenJob>& open,
                                  const std::set<std::string>& ids) {
  for (const OpenJob& job : open)
    if (!ids.contains(job.id)) parts_.store.remove_rest(job.id, job.renderer);
  std::vector<std::string> refused;
  {
    const std::scoped_lock lock(mutex_);
    std::set_intersection(refused_.begin(), refused_.end(), ids.begin(), ids.end(),
                          std::back_inserter(refused));
  }
  for (const std::string& id : refused) {
    parts_.store.remove_job(id);
    const std::scoped_lock lock(mutex_);
    refused_.erase(id);
  }
}

void Reconciler::look_at(const std::string& id, const std::vector<OpenJob>& open) {
  const auto record = parts_.store.job(id);
  if (!record) return;
  const bool is_of_this = record->front == parts_.front;
  const bool front_lives = is_of_this || !attendance_.is_silent(record->front);
  if (record->has_client && !(is_of_this ? parts_.is_awaited(id) : front_lives))
    return parts_.store.remove_job(id);
  const auto is = [&](JobStatus status) {
    if (record->has_client) return;
    note(id, status);
    if (has_ended(status)) ended_.insert(id);
  };
  if (!record->failure.empty()) {
    lacking_.erase(id);
    return is(JobStatus::failed);
  }
  is(record->task_count == 0 ? JobStatus::queued : JobStatus::running);
  if (record->task_count == 0) {
    if (record->has_client) return;  // its front is about to cut it
    // Its front has it in work, but for what it was told was not stored when NATS went away.
    if ((is_of_this || !front_lives) && !parts_.is_in_work(id)) parts_.take_over(*record);
    return;
  }
  const std::set<int> done = parts_.store.results(id);
  const std::vector<int> missing = missing_tasks(record->task_count, done);
  if (missing.empty()) {
    parts_.store.close_job(*record);
    lacking_.erase(id);
    return is(JobStatus::done);
  }
  if (!lost_tasks(id, queued_tasks(open, id), missing.size())) return;
  parts_.log.note(fmt::format("job {}: {} tasks are queued again", id, missing.size()));
  parts_.store.queue_tasks(*record, missing);
}

bool Reconciler::lost_tasks(const std::string& id, std::uint64_t queued, std::size_t missing) {
  // Between two looks results come in: only what is lacking twice is lost.
  const bool lacks = queued < missing;
  const bool lacked_before = lacks && lacking_.contains(id) && lacking_.at(id) == missing;
  lacking_.erase(id);
  if (lacks) lacking_.emplace(id, missing);
  return lacked_before;
}

}  // namespace raytracer

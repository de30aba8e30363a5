#include "server/cluster/shared_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/cluster/answered.h"
#include "server/cluster/members.h"
#include "server/problem.h"

namespace raytracer {
namespace {

/// So that whoever asks often does not ask NATS as often.
constexpr std::chrono::milliseconds between_looks{10};
constexpr std::chrono::seconds between_roll_calls{1};

}  // namespace

SharedJob::SharedJob(const JobRecord& record, ClusterStore& store, News& news)
    : Job({.id = record.id,
           .task = record.task,
           .digest = record.picture_digest,
           .parse_ms = record.parse_ms,
           .width = record.width,
           .height = record.height,
           .channels = record.channels}),
      store_(store),
      news_(news),
      record_(record),
      collector_(store) {}

SharedJob::Clock::time_point SharedJob::due() const {
  return looked_ + std::max<Clock::duration>(between_looks, Collector::least_period(record_));
}

void SharedJob::look() const {
  if (Clock::now() < due()) return;
  try {
    look_now();
  } catch (const NatsUnavailable&) {
    // What was known last is said: NATS may have taken seconds, which others need not wait again.
    looked_ = Clock::now();
  }
}

void SharedJob::look_now() const {
  if (has_ended(status())) return;
  std::optional<JobRecord> record = store_.job(request.id);
  if (!record) {
    removed_ms_ = now_ms();
    return;
  }
  record_ = *std::move(record);
  if (collector_.collect(record_)) {
    has_workers_ = true;
    looked_for_workers_ = Clock::now();
  }
  if (collector_.is_complete(record_))
    result_ = collector_.take_result(record_);
  else
    look_for_workers();
  looked_ = Clock::now();
}

void SharedJob::look_again() const {
  const std::scoped_lock lock(mutex_);
  looked_ = {};
}

void SharedJob::look_for_workers() const {
  if (Clock::now() - looked_for_workers_ < between_roll_calls) return;
  has_workers_ = has_worker(store_.members(), record_.renderer, store_.limits());
  looked_for_workers_ = Clock::now();
}

JobStatus SharedJob::status() const {
  if (result_) return JobStatus::done;
  if (removed_ms_ > 0) return JobStatus::cancelled;
  if (!record_.failure.empty()) return JobStatus::failed;
  return collector_.progress(record_) > 0 || record_.task_count > 0 ? JobStatus::running
                                                                    : JobStatus::queued;
}

std::string SharedJob::detail() const {
  if (removed_ms_ > 0) return "deleted, or forgotten (--keep)";
  if (!record_.failure.empty()) return record_.failure;
  if (result_ || has_workers_) return "";
  return fmt::format("It waits for a worker: none of its build ({}) has been heard of",
                     record_.renderer);
}

JobState SharedJob::state() const {
  const std::scoped_lock lock(mutex_);
  look();
  const JobStatus now = status();
  const std::int64_t until = now == JobStatus::done        ? collector_.last_ms()
                             : now == JobStatus::failed    ? record_.stored_ms
                             : now == JobStatus::cancelled ? removed_ms_
                                                           : now_ms();
  return {.status = now,
          .progress = result_ ? 1 : collector_.progress(record_),
          .elapsed_ms = static_cast<double>(std::max(until - record_.accepted_ms, std::int64_t{0})),
          .queue_ms = record_.queue_ms,
          .detail = detail()};
}

void SharedJob::wait_for_end(std::chrono::milliseconds longest) const {
  std::uint64_t seen = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (has_ended(status())) return;
    seen = seen_;
  }
  const auto end = Clock::now() + longest;
  news_.wait(seen, longest);
  Clock::time_point next_look;
  {
    const std::scoped_lock lock(mutex_);
    seen_ = seen;
    next_look = due();
  }
  std::this_thread::sleep_until(std::min(next_look, end));  // more may come meanwhile
}

JobResult SharedJob::take_result() {
  const std::scoped_lock lock(mutex_);
  if (removed_ms_ > 0)
    refuse(503, "The render was lost with what NATS had stored of it; try again",
           {{"Retry-After", "1"}});
  if (record_.lacked_room) refuse(503, record_.failure, {{"Retry-After", full_store_retry_after}});
  if (!record_.failure.empty()) throw std::runtime_error(record_.failure);
  return std::exchange(result_, JobResult()).value();
}

const JobResult* SharedJob::result() const {
  const std::scoped_lock lock(mutex_);
  look();
  return result_ ? &*result_ : nullptr;
}

std::optional<Image> SharedJob::image_so_far() const {
  const std::scoped_lock lock(mutex_);
  answered([&] { look_now(); });
  if (has_ended(status())) return {};
  if (std::optional<Image> image = collector_.image_so_far()) return image;
  Image black(request.width, request.height, request.channels);
  std::fill(black.values.begin(), black.values.end(), 0.0F);
  return black;
}

Sharing SharedJob::sharing() const {
  const std::scoped_lock lock(mutex_);
  return {record_.task_count, collector_.worker_count(), record_.renderer};
}

}  // namespace raytracer

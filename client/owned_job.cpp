#include "client/owned_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "client/failure.h"
#include "client/progress_bar.h"

namespace raytracer::client {

using std::chrono::microseconds;

namespace {

bool is_open(const Job& job) { return job.status == "queued" || job.status == "running"; }

}  // namespace

bool OwnedJob::has_ended() {
  if (is_open(job_)) job_ = api_.job(job_.id);
  return !is_open(job_);
}

void OwnedJob::wait(const std::string& doing) {
  ProgressBar bar;
  wait(doing,
       [&](const Job& job) { bar.show(job.status == "queued" ? "queued" : doing, job.progress); });
}

void OwnedJob::wait(const std::string& doing, const std::function<void(const Job&)>& show) {
  // So that no more than a small part of the time is lost, and of a short render not much either.
  constexpr int lost_of = 20;
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  for (; is_open(job_); job_ = api_.job(job_.id)) {
    show(job_);
    const auto waited = std::chrono::duration_cast<microseconds>(Clock::now() - begin);
    api_.pause(std::clamp(waited / lost_of, microseconds(1000), microseconds(200'000)));
  }
  if (job_.status != "done")
    throw ServerError(fmt::format("{}: the server's job is {}{}{}", doing, job_.status,
                                  job_.detail.empty() ? "" : ": ", job_.detail));
}

}  // namespace raytracer::client

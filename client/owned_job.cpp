#include "client/owned_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "client/failure.h"
#include "client/progress_bar.h"

namespace raytracer::client {

using std::chrono::microseconds;

void OwnedJob::wait(const std::string& doing) {
  ProgressBar bar;
  wait(doing,
       [&](const Job& job) { bar.show(job.status == "queued" ? "queued" : doing, job.progress); });
}

void OwnedJob::wait(const std::string& doing, const std::function<void(const Job&)>& show) {
  microseconds pause(1000);
  for (; job_.status == "queued" || job_.status == "running"; job_ = api_.job(job_.id)) {
    show(job_);
    api_.pause(pause);
    pause = std::min(pause * 3 / 2, microseconds(200'000));
  }
  if (job_.status != "done")
    throw ServerError(fmt::format("{}: the server's job is {}{}{}", doing, job_.status,
                                  job_.detail.empty() ? "" : ": ", job_.detail));
}

}  // namespace raytracer::client

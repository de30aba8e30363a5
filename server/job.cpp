#include "server/job.h"

namespace raytracer {

std::string_view name_of(JobStatus status) {
  constexpr std::array<std::string_view, job_statuses.size()> names{"queued", "running", "done",
                                                                    "failed", "cancelled"};
  return names[static_cast<std::size_t>(status)];
}

std::string_view name_of(JobTask task) { return task == JobTask::render ? "render" : "tradeoff"; }

}  // namespace raytracer

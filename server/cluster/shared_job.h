// A job of the cluster, as any front sees it.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "server/cluster/collector.h"
#include "server/cluster/news.h"
#include "server/cluster/record.h"
#include "server/cluster/store.h"
#include "server/job.h"

namespace raytracer {

/// While NATS is away its state is what was known last.
class SharedJob : public Job {
 public:
  /// Both must outlive it.
  SharedJob(const JobRecord& record, ClusterStore& store, News& news);

  /// What is asked for next is as it is then, not as it was a moment ago: whoever heard from
  /// another front that it is done shall not hear less here.
  void look_again() const;

  JobState state() const override;
  void wait_for_end(std::chrono::milliseconds longest) const override;
  const JobResult* result() const override;
  /// Throws HttpError 503.
  std::optional<Image> image_so_far() const override;
  Sharing sharing() const override;

  /// Once it has failed or was removed: throws what a client that waited for it is told, HttpError
  /// 503 or std::runtime_error. Once it is done: moves its result out, and then it has none.
  JobResult take_result();

 private:
  using Clock = std::chrono::steady_clock;

  // With the mutex held.
  void look() const;  ///< unless that was a moment ago
  Clock::time_point due() const;
  void look_now() const;  ///< throws as ClusterStore does
  void look_for_workers() const;
  JobStatus status() const;
  std::string detail() const;

  ClusterStore& store_;
  News& news_;
  mutable std::mutex mutex_;
  mutable Clock::time_point looked_{};
  mutable Clock::time_point looked_for_workers_{};
  mutable JobRecord record_;
  mutable std::int64_t removed_ms_ = 0;  ///< 0: it was not
  mutable bool has_workers_ = true;      ///< who could take its tasks
  mutable Collector collector_;
  mutable std::optional<JobResult> result_;
  mutable std::uint64_t seen_ = 0;
};

}  // namespace raytracer

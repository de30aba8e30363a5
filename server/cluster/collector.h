// What the tasks of one job have come to so far, put together.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "server/cluster/record.h"
#include "server/cluster/store.h"
#include "server/job.h"

namespace raytracer {

/// For one thread at a time.
class Collector {
 public:
  /// `store` must outlive it.
  explicit Collector(ClusterStore& store) : store_(store) {}

  /// Fetches what is stored of the job that was not fetched before. Throws NatsUnavailable,
  /// NatsRefused. Returns whether there was something.
  bool collect(const JobRecord& record);
  /// How long to wait between two calls: to list many tasks takes NATS long.
  static std::chrono::microseconds least_period(const JobRecord& record);
  bool is_complete(const JobRecord& record) const;

  double progress(const JobRecord& record) const;
  /// When the last result so far was stored, in milliseconds since 1970.
  std::int64_t last_ms() const { return last_ms_; }
  std::size_t worker_count() const { return workers_.size(); }

  /// The picture so far, of a render in regions.
  std::optional<Image> image_so_far() const;
  /// Of a complete job: what it came to. At most once.
  JobResult take_result(const JobRecord& record);

 private:
  void add(const JobRecord& record, StoredMessage message);

  ClusterStore& store_;
  std::set<int> done_;
  std::set<std::string> workers_;
  std::int64_t last_ms_ = 0;
  double whole_progress_ = 0;
  std::variant<std::monostate, ImageOfRegions<float>, ImageOfRegions<unsigned char>, Rendering,
               CurveText>
      made_;
};

}  // namespace raytracer

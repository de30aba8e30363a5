// Waits for something to happen anywhere in the cluster.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "server/cluster/store.h"

namespace raytracer {

class News {
 public:
  /// Of tasks and jobs, and of results if those matter.
  News(ClusterStore& store, bool with_results)
      : subscription_(store.listen_for_news([this] { tell(); }, with_results)) {}

  /// Returns when something has happened since `seen`, which then counts it, or after `longest`:
  /// a signal may be lost.
  void wait(std::uint64_t& seen, std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [&] { return count_ != seen; });
    seen = count_;
  }

  /// Something has happened here.
  void tell() {
    {
      const std::scoped_lock lock(mutex_);
      ++count_;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t count_ = 0;
  std::shared_ptr<const void> subscription_;  ///< ends first
};

}  // namespace raytracer

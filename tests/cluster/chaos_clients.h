// Clients of a cluster whose parts die: they ask again elsewhere, and forgive nothing else.
#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/cluster/chaos_cluster.h"

namespace raytracer::test {

struct ChaosPicture {
  std::string query;
  std::string document;  ///< empty: a shipped scene
  std::string expected;  ///< its bytes
};

/// The pictures that they ask for, as one server alone makes them.
std::vector<ChaosPicture> chaos_pictures();

/// Jobs in work all the time, until told to finish.
class ChaosClients {
 public:
  ChaosClients(const ChaosCluster& cluster, std::vector<ChaosPicture> pictures, unsigned seed);
  ~ChaosClients();
  ChaosClients(const ChaosClients&) = delete;
  ChaosClients& operator=(const ChaosClients&) = delete;

  int accepted() const { return accepted_; }
  int ended() const { return ended_; }
  std::vector<std::string> faults() const;

  /// Begins nothing more, and waits for what was accepted.
  void finish();

 private:
  struct Job {
    std::string path;
    const ChaosPicture* picture;
    std::chrono::steady_clock::time_point accepted;
  };

  void work(unsigned seed);
  std::string begin(const ChaosPicture& picture, std::mt19937& random);
  bool has_ended(const Job& job, std::mt19937& random);
  httplib::Client any_front(std::mt19937& random) const;
  void fault(const Job& job, const std::string& what);

  const ChaosCluster& cluster_;
  const std::vector<ChaosPicture> pictures_;
  std::atomic<bool> is_finishing_{false};
  std::atomic<int> accepted_{0};
  std::atomic<int> ended_{0};
  mutable std::mutex mutex_;
  std::vector<std::string> faults_;
  std::vector<std::thread> threads_;
};

}  // namespace raytracer::test

// A cluster whose parts are killed at any moment and started again.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "tests/cluster/nats_server.h"
#include "tests/process/server_process.h"

namespace raytracer::test {

enum class Part { worker, front, nats };

/// Parts are started by one thread, which has to live as long as they do.
class ChaosCluster {
 public:
  explicit ChaosCluster(std::chrono::seconds keep);

  const std::string& nats_url() const { return nats_.url(); }
  /// The ports of the fronts, from any thread; some may be dead.
  std::vector<int> front_ports() const;

  /// Kills such a part with -9, the one that chance says.
  void kill(Part part, std::mt19937& random);
  /// Starts what is dead again.
  void restart();

  /// What its servers said, as far as they live.
  std::string log() const;

 private:
  using Flags = std::vector<std::string>;
  using Servers = std::vector<std::unique_ptr<ServerProcess>>;

  std::unique_ptr<ServerProcess> start(Flags flags) const;

  NatsServer nats_;
  bool nats_lives_ = true;
  std::vector<std::string> flags_;
  Servers fronts_;
  Servers workers_;
  mutable std::mutex mutex_;
  std::vector<int> front_ports_;
};

}  // namespace raytracer::test

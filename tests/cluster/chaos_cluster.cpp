#include "tests/cluster/chaos_cluster.h"

#include <csignal>

#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

constexpr std::size_t front_count = 2;
constexpr std::size_t worker_count = 3;

}  // namespace

ChaosCluster::ChaosCluster(std::chrono::seconds keep)
    : flags_{"--nats", nats_.url(),      "--threads", "1",      "--share-from",
             "10",     "--task-timeout", "1",         "--keep", std::to_string(keep.count())},
      fronts_(front_count),
      workers_(worker_count) {
  restart();
}

std::unique_ptr<ServerProcess> ChaosCluster::start(Flags flags) const {
  flags.insert(flags.end(), flags_.begin(), flags_.end());
  return std::make_unique<ServerProcess>(std::move(flags));
}

std::vector<int> ChaosCluster::front_ports() const {
  const std::scoped_lock lock(mutex_);
  return front_ports_;
}

void ChaosCluster::kill(Part part, std::mt19937& random) {
  if (part == Part::nats) {
    nats_.kill();
    nats_lives_ = false;
    return;
  }
  Servers& servers = part == Part::front ? fronts_ : workers_;
  std::unique_ptr<ServerProcess>& server = servers[random() % servers.size()];
  server->signal(SIGKILL);
  server->wait();
  server.reset();
}

void ChaosCluster::restart() {
  if (!nats_lives_) nats_.start();
  nats_lives_ = true;
  for (auto& worker : workers_)
    if (!worker) worker = start({"--worker"});
  for (std::size_t i = 0; i < fronts_.size(); ++i)
    if (!fronts_[i]) fronts_[i] = start(i == 0 ? Flags{"--no-work"} : Flags{});
  const std::scoped_lock lock(mutex_);
  front_ports_.clear();
  for (const auto& front : fronts_) front_ports_.push_back(front->port());
}

std::string ChaosCluster::log() const {
  std::string text;
  for (const Servers* const servers : {&fronts_, &workers_})
    for (const auto& server : *servers)
      if (server) text += server->url() + ":\n" + server->log();
  return text;
}

}  // namespace raytracer::test

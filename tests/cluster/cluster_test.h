// What every test of a cluster stands on: NATS and servers of its own, and what they say.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/cluster/nats_server.h"
#include "tests/process/patience.h"
#include "tests/service/service.h"

namespace raytracer::test {

using Flags = std::vector<std::string>;

/// Skipped where there is no nats-server.
class ClusterTest : public testing::Test {
 protected:
  void SetUp() override;

  /// A server of one thread that shares whatever it is asked for; `flags` come last.
  ServerProcess& start(Flags flags);
  ServerProcess& start_front(Flags flags = {});  ///< that does no work
  ServerProcess& start_worker(Flags flags = {});

  NatsServer& nats() { return *nats_; }

 private:
  std::optional<NatsServer> nats_;
  std::vector<std::unique_ptr<ServerProcess>> servers_;
};

/// How many servers that work were heard of in the last seconds, as this one says.
std::size_t worker_count(const ServerProcess& front);
/// Whether that many workers are there, before long.
bool has_workers(const ServerProcess& front, std::size_t count);

/// What /readyz says of a server that is ready; empty if it is not.
std::string readiness(const ServerProcess& server);
/// Whether /readyz says so before long.
bool becomes(const ServerProcess& server, const std::string& readiness);
/// Whether the server's log says so before long.
bool comes_to_say(const ServerProcess& server, const std::string& text);

nlohmann::json cluster_of(const ServerProcess& front);
/// Tasks that wait or run.
std::uint64_t task_count(const ServerProcess& front);

/// The sum of a metric's values over its labels; 0 if there is none.
double metric_of(const ServerProcess& server, const std::string& name);

/// The job's path, "/jobs/ID"; fails the test if it is not accepted.
std::string post_job(const ServerProcess& front, const std::string& query,
                     const std::string& document = "");
std::string status_of(const ServerProcess& front, const std::string& job);
/// Whether the job is done before long; says what it is if not.
testing::AssertionResult ends_done(
    const ServerProcess& front, const std::string& job,
    std::chrono::milliseconds limit = std::chrono::milliseconds(30'000));
/// Whether some of its results are there, and not all.
bool is_half_way(const ServerProcess& front, const std::string& job);

/// The picture that one server alone makes of it.
std::string alone(const std::string& target, const std::string& document = "",
                  std::string_view type = "image/png");

/// A scene whose picture takes a thread about `work` hundredths of a second: long enough for what
/// is to happen meanwhile, on machines several times as fast, too.
std::string long_scene(int work);
int samples_of_long_scene(int work);  ///< per pixel

}  // namespace raytracer::test

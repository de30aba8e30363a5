#include "tests/cluster/cluster_test.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "tests/service/documents.h"

namespace raytracer::test {

void ClusterTest::SetUp() {
  if (NatsServer::program().empty()) GTEST_SKIP() << "nats-server is not installed";
  nats_.emplace();
}

ServerProcess& ClusterTest::start(Flags flags) {
  // By variables, which flags stand over.
  return *servers_.emplace_back(std::make_unique<ServerProcess>(
      std::move(flags), std::map<std::string, std::string>{{"RAYTRACER_NATS", nats_->url()},
                                                           {"RAYTRACER_THREADS", "1"},
                                                           {"RAYTRACER_SHARE_FROM", "0"}}));
}

ServerProcess& ClusterTest::start_front(Flags flags) {
  flags.insert(flags.begin(), "--no-work");
  return start(std::move(flags));
}

ServerProcess& ClusterTest::start_worker(Flags flags) {
  flags.insert(flags.begin(), "--worker");
  return start(std::move(flags));
}

std::string readiness(const ServerProcess& server) {
  const Answer answer = get(server, "/readyz");
  return answer.status == 200 ? json_of(answer).value("status", "") : "";
}

bool becomes(const ServerProcess& server, const std::string& wanted) {
  return eventually([&] { return readiness(server) == wanted; });
}

bool comes_to_say(const ServerProcess& server, const std::string& text) {
  return eventually([&] { return server.log().find(text) != std::string::npos; });
}

nlohmann::json cluster_of(const ServerProcess& front) {
  const Answer answer = get(front, "/cluster");
  return answer.status == 200 ? json_of(answer) : nlohmann::json();
}

std::size_t worker_count(const ServerProcess& front) {
  constexpr double lately_s = 2;
  std::size_t count = 0;
  const nlohmann::json cluster = cluster_of(front);
  if (!cluster.is_object()) return 0;
  for (const nlohmann::json& member : cluster.at("workers"))
    if (member.at("last_heard_s") < lately_s) ++count;
  return count;
}

bool has_workers(const ServerProcess& front, std::size_t count) {
  return eventually([&] { return worker_count(front) == count; });
}

std::uint64_t task_count(const ServerProcess& front) {
  const nlohmann::json cluster = cluster_of(front);
  if (!cluster.is_object()) throw std::runtime_error("the front does not see its cluster");
  const nlohmann::json tasks = cluster.at("tasks");
  return tasks.at("waiting").get<std::uint64_t>() + tasks.at("running").get<std::uint64_t>();
}

double metric_of(const ServerProcess& server, const std::string& name) {
  double sum = 0;
  std::istringstream lines(get(server, "/metrics").body);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(name + " ") || line.starts_with(name + "{"))
      sum += std::stod(line.substr(line.rfind(' ')));
  return sum;
}

std::string post_job(const ServerProcess& front, const std::string& query,
                     const std::string& document) {
  const Answer answer = post(front, "/jobs" + query, document);
  EXPECT_EQ(answer.status, 202) << answer.body;
  return answer.get_header_value("Location");
}

std::string status_of(const ServerProcess& front, const std::string& job) {
  const Answer answer = get(front, job);
  return answer.status == 200 ? json_of(answer).value("status", "") : "";
}

testing::AssertionResult ends_done(const ServerProcess& front, const std::string& job,
                                   std::chrono::milliseconds limit) {
  if (eventually(
          [&] {
            const std::string status = status_of(front, job);
            return status == "done" || status == "failed" || status == "cancelled";
          },
          limit) &&
      status_of(front, job) == "done")
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << get(front, job).body << "\nthe cluster:\n"
                                     << get(front, "/cluster").body << "\nthe front's log:\n"
                                     << front.log();
}

bool is_half_way(const ServerProcess& front, const std::string& job) {
  std::string status;
  return eventually([&] {
           const Answer answer = get(front, job);
           if (answer.status != 200) return false;
           const nlohmann::json state = json_of(answer);
           status = state.at("status");
           return state.at("progress") > 0;
         }) &&
         status == "running";
}

std::string alone(const std::string& target, const std::string& document, std::string_view type) {
  const ServerProcess server;
  const Answer answer = document.empty()
                            ? get(server, target, {{"Accept", std::string(type)}})
                            : post(server, target, document, {{"Accept", std::string(type)}});
  EXPECT_EQ(answer.status, 200) << answer.body;
  return answer.body;
}

int samples_of_long_scene(int work) { return 16 * work; }

std::string long_scene(int work) { return square_scene(350, samples_of_long_scene(work)); }

}  // namespace raytracer::test

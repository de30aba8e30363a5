#include "tests/measure/cluster/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/process/patience.h"

namespace raytracer::measure {
namespace {

/// As any front says; null while it cannot.
nlohmann::json cluster_of(const test::ServerProcess& front) {
  const httplib::Result answer = front.client().Get("/cluster");
  return answer && answer->status == 200 ? nlohmann::json::parse(answer->body) : nlohmann::json();
}

std::runtime_error failure(const std::string& target, const httplib::Result& answer) {
  return std::runtime_error(fmt::format("{}: {}", target,
                                        answer
                                            ? fmt::format("{} {}", answer->status, answer->body)
                                            : "no answer: " + httplib::to_string(answer.error())));
}

template <typename Predicate>
void await(const test::ServerProcess& front, const std::string& what, Predicate holds) {
  const bool is_so = test::eventually([&] {
    const nlohmann::json cluster = cluster_of(front);
    return !cluster.is_null() && holds(cluster);
  });
  if (!is_so) throw std::runtime_error(what + " in vain; the front said:\n" + front.log());
}

}  // namespace

void await_workers(const test::ServerProcess& front, std::size_t count) {
  constexpr double lately_s = 2;
  await(front, fmt::format("waited for {} workers", count), [&](const nlohmann::json& cluster) {
    const nlohmann::json& workers = cluster.at("workers");
    return static_cast<std::size_t>(
               std::count_if(workers.begin(), workers.end(), [](const nlohmann::json& worker) {
                 return worker.at("last_heard_s") < lately_s;
               })) == count;
  });
}

void await_running_task(const test::ServerProcess& front) {
  await(front, "waited for a task to run",
        [](const nlohmann::json& cluster) { return cluster.at("tasks").at("running") > 0; });
}

std::string begin_job(const test::ServerProcess& server, const std::string& query) {
  const std::string target = "/jobs?" + query;
  const httplib::Result answer = server.client().Post(target);
  if (!answer || answer->status != 202) throw failure(target, answer);
  return answer->get_header_value("Location");
}

void await_end(const test::ServerProcess& server, const std::string& job) {
  const httplib::Result events = server.client().Get(job + "/events");
  if (!events || events->body.find("event: done\n") == std::string::npos)
    throw failure(job + "/events", events);
}

std::string get(const test::ServerProcess& server, const std::string& target) {
  httplib::Result answer = server.client().Get(target);
  if (!answer || answer->status != 200) throw failure(target, answer);
  return std::move(answer->body);
}

}  // namespace raytracer::measure

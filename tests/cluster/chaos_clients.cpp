#include "tests/cluster/chaos_clients.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "tests/cluster/stored.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

constexpr unsigned client_count = 2;
constexpr std::size_t jobs_each = 2;
constexpr auto longest_job = 60s;  // accepted, through all that dies meanwhile

}  // namespace

std::vector<ChaosPicture> chaos_pictures() {
  const std::string sphere =
      R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.5, "width": 350,
          "height": 350}, "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
          "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}],
          "render": {"samples": 160}})";
  std::vector<ChaosPicture> pictures{
      {"?samples=200", sphere, ""},
      {"?samples=120&transfer=srgb", sphere, ""},
      {"?scene=demo&samples=16&width=320&height=240", "", ""},
      {"?scene=square-500&samples=16&width=200&height=150", "", ""},
      {"?scene=spheres&samples=4&width=900&height=600", "", ""},
      {"?scene=first-sphere&target_rmse=0.002&width=200&height=150", "", ""}};
  const ServerProcess alone;
  for (ChaosPicture& picture : pictures) {
    httplib::Client client = alone.client();
    const std::string target = "/render" + picture.query;
    const httplib::Result answer = picture.document.empty()
                                       ? client.Get(target)
                                       : client.Post(target, picture.document, "application/json");
    if (!answer || answer->status != 200)
      throw std::runtime_error(target + " cannot be rendered by a server alone");
    picture.expected = answer->body;
  }
  return pictures;
}

ChaosClients::ChaosClients(const ChaosCluster& cluster, std::vector<ChaosPicture> pictures,
                           unsigned seed)
    : cluster_(cluster), pictures_(std::move(pictures)) {
  std::signal(SIGPIPE, SIG_IGN);
  for (unsigned i = 0; i < client_count; ++i)
    threads_.emplace_back([this, seed, i] { work(client_count * seed + i); });
}

ChaosClients::~ChaosClients() { finish(); }

void ChaosClients::finish() {
  is_finishing_ = true;
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
}

std::vector<std::string> ChaosClients::faults() const {
  const std::scoped_lock lock(mutex_);
  return faults_;
}

void ChaosClients::fault(const Job& job, const std::string& what) {
  const std::scoped_lock lock(mutex_);
  faults_.push_back(fmt::format("{}{}: {}", job.path, job.picture->query, what));
}

void ChaosClients::work(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Job> jobs;
  while (!is_finishing_ || !jobs.empty()) {
    if (!is_finishing_ && jobs.size() < jobs_each) {
      const ChaosPicture& picture = pictures_[random() % pictures_.size()];
      const std::string path = begin(picture, random);
      if (!path.empty()) jobs.push_back({path, &picture, std::chrono::steady_clock::now()});
    }
    std::erase_if(jobs, [&](const Job& job) { return has_ended(job, random); });
    std::this_thread::sleep_for(20ms);
  }
}

httplib::Client ChaosClients::any_front(std::mt19937& random) const {
  const std::vector<int> ports = cluster_.front_ports();
  httplib::Client client("127.0.0.1", ports[random() % ports.size()]);
  client.set_connection_timeout(5);
  client.set_read_timeout(20);
  return client;
}

/// The job's path; empty if it was not accepted, or nobody said that it was.
std::string ChaosClients::begin(const ChaosPicture& picture, std::mt19937& random) {
  const httplib::Result answer =
      any_front(random).Post("/jobs" + picture.query, picture.document, "application/json");
  if (!answer) return "";
  const std::string path = answer->get_header_value("Location");
  if (answer->status == 202)
    ++accepted_;
  else if (answer->status != 503 && answer->status != 429)
    fault({"POST", &picture, {}}, fmt::format("{} {}", answer->status, answer->body));
  return answer->status == 202 ? path : "";
}

bool ChaosClients::has_ended(const Job& job, std::mt19937& random) {
  if (std::chrono::steady_clock::now() - job.accepted > patience(longest_job)) {
    const httplib::Result last = any_front(random).Get(job.path);
    fault(job, "does not end: " + (last ? last->body : "no answer"));
    return true;
  }
  const httplib::Result answer = any_front(random).Get(job.path);
  if (!answer || answer->status == 503) return false;  // whoever was asked, or NATS, is away
  const auto json = nlohmann::json::parse(answer->body, nullptr, false);
  if (answer->status != 200 || json.is_discarded()) {
    fault(job, fmt::format("{} {}", answer->status, answer->body));
    return true;
  }
  const std::string status = json.value("status", "");
  if (status == "queued" || status == "running") return false;
  if (status != "done") {
    fault(job, answer->body);
    return true;
  }
  const httplib::Result image = any_front(random).Get(job.path + "/image");
  if (!image || image->status == 503) return false;
  if (image->status != 200 || image->body != job.picture->expected)
    fault(job, fmt::format("another picture: {}, {} bytes", image->status, image->body.size()));
  // Each task has one result.
  try {
    Stored stored(cluster_.nats_url());
    const std::string id = job.path.substr(std::string_view("/jobs/").size());
    const auto record = stored.store.job(id);
    const std::size_t results = stored.store.results(id).size();
    // One that a front rendered itself may have its result before its record says so.
    const int tasks = record ? std::max(record->task_count, 1) : -1;
    if (static_cast<int>(results) != tasks)
      fault(job, fmt::format("{} results of {} tasks", results, tasks));
  } catch (const std::exception&) {
    return false;  // NATS is away
  }
  // Some are deleted, some are left to be forgotten.
  if (random() % 2 == 0) any_front(random).Delete(job.path);
  ++ended_;
  return true;
}

}  // namespace raytracer::test

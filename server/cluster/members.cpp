#include "server/cluster/members.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace raytracer {

double silence_s(const Member& member) {
  return std::max(static_cast<double>(now_ms() - member.heard_ms) / 1000, 0.0);
}

bool is_alive(const Member& member, const StoreLimits& limits) {
  return std::chrono::duration<double>(silence_s(member)) < limits.task_timeout;
}

bool has_worker(const std::vector<Member>& members, const std::string& renderer,
                const StoreLimits& limits) {
  return std::any_of(members.begin(), members.end(), [&](const Member& member) {
    return member.works && member.renderer == renderer && is_alive(member, limits);
  });
}

bool lives(const std::vector<Member>& members, const std::string& name, const StoreLimits& limits) {
  return std::any_of(members.begin(), members.end(), [&](const Member& member) {
    return member.name == name && is_alive(member, limits);
  });
}

SignsOfLife::SignsOfLife(ClusterStore& store, std::function<Member()> describe)
    : store_(store),
      describe_(std::move(describe)),
      thread_([this](const std::stop_token& end) { say_until_end(end); }) {}

SignsOfLife::~SignsOfLife() {
  thread_.request_stop();
  thread_.join();
  try {
    store_.remove_member(describe_().name);
  } catch (const std::exception&) {  // NOLINT: it is forgotten by itself
  }
}

void SignsOfLife::say_until_end(const std::stop_token& end) {
  constexpr std::chrono::milliseconds longest{1000};
  const auto period = std::min(longest, store_.limits().task_timeout / 4);
  std::mutex mutex;
  std::condition_variable_any ended;
  while (!end.stop_requested()) {
    try {
      store_.put_member(describe_());
    } catch (const std::exception&) {
      // At the first start, or after its storage was lost, NATS has no streams.
      try {
        store_.ensure_streams();
      } catch (const std::exception&) {  // NOLINT: it is tried again
      }
    }
    std::unique_lock lock(mutex);
    ended.wait_for(lock, end, period, [&] { return end.stop_requested(); });
  }
}

}  // namespace raytracer

#include "server/cluster/members.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace raytracer {

bool is_alive(const Member& member, const StoreLimits& limits) {
  return std::chrono::duration<double>(member.silence_s) < limits.task_timeout;
}

bool has_worker(const std::vector<Member>& members, const std::string& renderer,
                const StoreLimits& limits) {
  return std::any_of(members.begin(), members.end(), [&](const Member& member) {
    return member.works && member.renderer == renderer && is_alive(member, limits);
  });
}

void Attendance::look(const std::vector<Member>& members) {
  const auto now = Clock::now();
  constexpr std::chrono::seconds between_any_looks{2};
  // Longer than rounds take: this server stood still.
  if (now - looked_ > std::max<Clock::duration>(4 * longest_silence_, between_any_looks))
    interrupt();
  looked_ = now;
  std::map<std::string, std::int64_t> heard;
  for (const Member& member : members) heard[member.name] = member.heard_ms;
  for (const auto& [name, heard_ms] : heard) signs_.try_emplace(name, Sign{heard_ms, now});
  for (auto& [name, sign] : signs_)
    if (const std::int64_t heard_ms = heard[name]; heard_ms != sign.heard_ms)
      sign = {heard_ms, now};
}

bool Attendance::is_silent(const std::string& name) {
  const Sign& sign = signs_.try_emplace(name, Sign{0, looked_}).first->second;
  return looked_ - sign.since > longest_silence_;
}

Heartbeat::Heartbeat(ClusterStore& store, std::function<Member()> describe, NatsNote note)
    : store_(store),
      describe_(std::move(describe)),
      note_(std::move(note)),
      thread_([this](const std::stop_token& end) { beat_until_end(end); }) {}

Heartbeat::~Heartbeat() {
  thread_.request_stop();
  thread_.join();
  try {
    store_.remove_member(describe_().name);
  } catch (const std::exception&) {  // NOLINT: it is forgotten by itself
  }
}

void Heartbeat::beat_until_end(const std::stop_token& end) {
  constexpr std::chrono::milliseconds longest{1000};
  const auto period = std::min(longest, store_.limits().task_timeout / 4);
  std::mutex mutex;
  std::condition_variable_any ended;
  while (!end.stop_requested()) {
    try {
      beat();
    } catch (const std::exception&) {  // NOLINT: it is tried again
    }
    note_trouble();
    std::unique_lock lock(mutex);
    ended.wait_for(lock, end, period, [&] { return end.stop_requested(); });
  }
}

void Heartbeat::beat() {
  if (has_changed_streams_ && store_.has_streams()) {
    try {
      return store_.put_member(describe_());
    } catch (const NatsAway&) {
      throw;
    } catch (const std::exception&) {  // NOLINT: its storage may be lost
    }
  }
  if (!has_changed_streams_)
    change_streams();  // first: smaller ones leave room for those that are missing
  store_.ensure_streams();
  store_.put_member(describe_());
}

void Heartbeat::change_streams() {
  try {
    const std::string changes = store_.change_streams();
    if (!changes.empty()) note_("NATS's streams are changed: " + changes);
  } catch (const NatsAway&) {
    throw;
  } catch (const NatsUnavailable&) {
    return;  // it is tried again; whoever makes streams says why
  } catch (const std::exception& error) {
    note_(fmt::format("NATS's streams stay as they are: {}", error.what()));
  }
  has_changed_streams_ = true;
}

/// Each trouble once, until there is none.
void Heartbeat::note_trouble() {
  const std::string trouble = store_.trouble();
  if (trouble.empty()) {
    if (!said_.empty()) note_("NATS's streams are there");
    said_.clear();
  } else if (said_.insert(trouble).second) {
    note_("jobs are refused: " + trouble);
  }
}

}  // namespace raytracer

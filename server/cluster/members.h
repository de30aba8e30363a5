// Who of a cluster lives, and the heartbeat of this one.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/cluster/store.h"

namespace raytracer {

/// Whether it was heard of lately.
bool is_alive(const Member& member, const StoreLimits& limits);

/// Whether somebody who was heard of lately takes tasks of this renderer.
bool has_worker(const std::vector<Member>& members, const std::string& renderer,
                const StoreLimits& limits);

/// Who has fallen silent while one looked on. When somebody was heard of last is not asked: after
/// NATS was away, or this server stood still, all have to speak again first.
class Attendance {
 public:
  explicit Attendance(std::chrono::milliseconds longest_silence)
      : longest_silence_(longest_silence) {}

  /// What members() says now; to be called again and again.
  void look(const std::vector<Member>& members);
  /// Nobody could look.
  void interrupt() { signs_.clear(); }
  /// Whether one of this name gave no sign for the longest silence, as of the last look.
  bool is_silent(const std::string& name);

 private:
  using Clock = std::chrono::steady_clock;
  struct Sign {
    std::int64_t heard_ms = 0;  ///< 0: none
    Clock::time_point since{};
  };

  const std::chrono::milliseconds longest_silence_;
  Clock::time_point looked_{};
  std::map<std::string, Sign> signs_;  ///< by names
};

/// Says that this server lives, several times within the tasks' timeout, until it ends; then that
/// it does not. Makes the streams for that and all else, as soon as NATS can be reached.
class Heartbeat {
 public:
  /// `describe` is called each time, on another thread. All must outlive it. The streams are
  /// changed as the store's limits say at the start; later another server's may count.
  Heartbeat(ClusterStore& store, std::function<Member()> describe, NatsNote note);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

 private:
  void beat_until_end(const std::stop_token& end);
  void beat();
  void change_streams();
  void note_trouble();

  ClusterStore& store_;
  std::function<Member()> describe_;
  bool has_changed_streams_ = false;
  NatsNote note_;
  std::set<std::string> said_;  ///< of the streams, since they were there
  std::jthread thread_;
};

}  // namespace raytracer

// Who renders now and who waits: a few at once, a bounded queue in order of arrival, then refusal.
//
// Running renders share the worker pool tile by tile, so a few at once keep it busy while short
// ones still pass long ones. An unbounded queue would end in clients that time out and retry.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/engine.h"

namespace raytracer {

/// Every member function may be called from any thread.
class Admission {
 public:
  Admission(std::size_t most_running, std::size_t most_waiting);

  class Place;
  class Companion;

  /// Takes the last place, running or waiting. `progress` must outlive the Place.
  /// Throws Refusal: 429 with Retry-After if the queue is full, 503 after close().
  Place enter(RenderProgress& progress);

  /// For who waits for somebody else's render: one of those who wait, without a turn of its own.
  /// Throws Refusal as enter() does.
  Companion accompany();

  /// Throws the 503 of a closed queue: for a look before a body is read.
  void demand_open() const;

  /// No new work from now on; those who wait are refused, those who run go on.
  void close();
  /// Asks those who run to stop within a tile.
  void stop_running();

  struct Load {
    std::size_t running = 0;
    std::size_t waiting = 0;
  };
  Load load() const;

  bool is_closed() const;
  bool is_full() const;
  /// True once nobody runs or waits; false if that takes longer than `timeout`.
  bool wait_until_empty(std::chrono::milliseconds timeout) const;

 private:
  struct Entry;
  using Clock = std::chrono::steady_clock;

  bool may_wait() const;
  [[noreturn]] void refuse_full() const;
  void leave(Entry& entry);
  void let_in_next();
  long retry_after_s() const;

  const std::size_t most_running_;
  const std::size_t most_waiting_;
  mutable std::mutex mutex_;
  mutable std::condition_variable emptied_;
  std::vector<Entry*> running_;
  std::deque<Entry*> waiting_;
  std::size_t companions_ = 0;
  std::atomic<bool> closed_{false};  ///< set with the mutex held
  double mean_render_s_ = 1;         ///< of late, the newest counting most
};

/// A place in the queue, then among those who run; given back at the end of its life.
class Admission::Place {
 public:
  Place(Place&&) noexcept;
  Place& operator=(Place&&) = delete;
  ~Place();

  /// Returns true when it is this place's turn, false soon after `progress.stop` was set.
  /// Throws Refusal 503 if the queue is closed before.
  bool wait_for_turn();

  /// From entering to the turn, in milliseconds.
  double queue_ms() const;

 private:
  friend class Admission;
  Place(Admission& admission, std::unique_ptr<Entry> entry);

  Admission* admission_;
  std::unique_ptr<Entry> entry_;
};

/// Who waits beside the queue, until the end of its life.
class Admission::Companion {
 public:
  explicit Companion(Admission& admission) : admission_(admission) {}
  ~Companion();
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;

 private:
  Admission& admission_;
};

}  // namespace raytracer

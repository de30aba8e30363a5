// Who renders now and who waits: a few at once, a bounded queue in order of arrival, then refusal.
//
// Running renders share the worker pool tile by tile, so a few at once keep it busy while short
// ones still pass long ones. An unbounded queue would end in clients that time out and retry.
//
// Whoever is admitted renders on its own thread: to wake up another takes as long as a small
// picture.
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

/// Nobody is told to come again later than that.
inline constexpr double longest_retry_after_s = 600;

/// Every member function may be called from any thread.
class Admission {
  using Clock = std::chrono::steady_clock;

 public:
  Admission(std::size_t most_running, std::size_t most_waiting);

  /// A place in the queue, then an admission slot among those who run, until the end of its life.
  class Slot {
   public:
    /// Takes the last place. Both must outlive it.
    /// Throws HttpError: 429 with Retry-After if the queue is full, 503 after close().
    Slot(Admission& admission, RenderProgress& progress);
    ~Slot();
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;

    /// Returns true once it is admitted, false if it was stopped before.
    /// Throws HttpError 503 if the queue is closed before.
    bool wait_until_admitted();

    /// From entering to the admission, in milliseconds.
    double queue_ms() const;

   private:
    friend class Admission;

    Admission& admission_;
    RenderProgress& progress_;
    const Clock::time_point entered_ = Clock::now();
    Clock::time_point started_{};  ///< when it was admitted
    bool is_running_ = false;
    std::condition_variable changed_;  ///< its own: an admission wakes nobody else
  };

  /// Ends one's waiting at once, and its work within a tile; also before it enters.
  void stop(RenderProgress& progress);

  /// For who waits for a render that others make: one of those who wait, without a slot of its own,
  /// until nobody holds it any more; it counts as one that runs when this is closed. Throws
  /// HttpError as Slot does. It must not outlive this.
  std::shared_ptr<const void> add_waiter(RenderProgress& progress);

  /// Throws the 503 of a closed queue: for a look before a body is read.
  void require_open() const;

  /// When those who run and wait now will have been served, in seconds from now, if those who run,
  /// here or elsewhere, go on as they did and those who wait take as long: what clients that are
  /// refused are told.
  long retry_after_s() const;

  /// close() comes soon: readiness ends, all else goes on.
  void announce_close() { closing_ = true; }
  /// No new work from now on; those who wait are refused, those who run go on.
  void close();
  /// Asks those who run to stop within a tile, and those who have not left the queue yet to do so.
  void stop_running();

  struct Load {
    std::size_t running = 0;
    std::size_t waiting = 0;
  };
  Load load() const;

  bool is_closed() const { return closed_; }
  bool is_closing() const { return closing_ || closed_; }
  /// Whether somebody who comes now is refused.
  bool is_full() const;
  /// True once nobody runs or waits; false if that takes longer than `timeout`.
  bool wait_until_empty(std::chrono::milliseconds timeout) const;

 private:
  /// A render that others make.
  struct Elsewhere {
    RenderProgress* progress;
    Clock::time_point began;
  };

  // With the mutex held.
  [[noreturn]] void refuse_closed() const;
  void require_place() const;
  bool may_wait() const { return waiting_.size() + elsewhere_.size() < most_waiting_; }
  void let_in_next();
  double whole_s(const RenderProgress& progress, double so_far_s) const;
  long seconds_until_served() const;

  const std::size_t most_running_;
  const std::size_t most_waiting_;
  mutable std::mutex mutex_;
  mutable std::condition_variable emptied_;
  std::vector<Slot*> running_;
  std::deque<Slot*> waiting_;
  std::vector<Elsewhere> elsewhere_;
  std::atomic<bool> closing_{false};
  std::atomic<bool> closed_{false};  ///< set with the mutex held
  double mean_render_s_ = 1;         ///< of late, the newest counting most
};

}  // namespace raytracer

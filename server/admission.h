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

class AdmissionSlot;

/// One of those who wait beside the queue, until nobody holds it any more.
using AdmissionWaiter = std::shared_ptr<const void>;

/// Every member function may be called from any thread.
class Admission {
 public:
  Admission(std::size_t most_running, std::size_t most_waiting);

  /// Takes the last slot, running or waiting. `progress` must outlive the AdmissionSlot.
  /// Throws HttpError: 429 with Retry-After if the queue is full, 503 after close().
  AdmissionSlot enter(RenderProgress& progress);

  /// For who waits for somebody else's render: one of those who wait, without a slot of its own.
  /// Throws HttpError as enter() does. The waiter must not outlive this.
  AdmissionWaiter add_waiter();

  /// Throws the 503 of a closed queue: for a look before a body is read.
  void require_open() const;

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
  friend class AdmissionSlot;
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
  std::atomic<std::size_t> extra_waiters_{0};
  std::atomic<bool> closed_{false};  ///< set with the mutex held
  double mean_render_s_ = 1;         ///< of late, the newest counting most
};

/// A place in the queue, then an admission slot: among those who run; given back at the end of its
/// life.
class AdmissionSlot {
 public:
  AdmissionSlot(AdmissionSlot&&) noexcept;
  AdmissionSlot& operator=(AdmissionSlot&&) = delete;
  ~AdmissionSlot();

  /// Returns true once it is admitted, false soon after `progress.stop` was set.
  /// Throws HttpError 503 if the queue is closed before.
  bool wait_until_admitted();

  /// From entering to the admission, in milliseconds.
  double queue_ms() const;

 private:
  friend class Admission;
  AdmissionSlot(Admission& admission, std::unique_ptr<Admission::Entry> entry);

  Admission* admission_;
  std::unique_ptr<Admission::Entry> entry_;
};

}  // namespace raytracer

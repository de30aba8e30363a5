// Ctrl-C while a server works for the client: what was begun is taken back before the client ends.
//
// The signals are blocked and a thread waits for them, so that nothing has to be safe inside a
// signal handler. The first one makes check() and sleep() throw and runs the callback, which is
// to cut short what blocks; a second one ends the process on the spot.
#pragma once

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <functional>
#include <mutex>
#include <thread>

namespace raytracer::client {

/// Takes SIGINT, SIGTERM and SIGHUP for as long as it lives; one at a time, made on the main
/// thread before any other thread.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// Throws Interrupted once a signal has arrived.
  void check() const;

  /// Waits; throws Interrupted as soon as a signal arrives.
  void sleep(std::chrono::microseconds duration) const;

  /// What the first signal calls, on a thread of its own; nullptr for nothing. Returns when a call
  /// of the one before has ended.
  void on_signal(std::function<void()> callback);

 private:
  void watch();

  sigset_t signals_{};
  sigset_t mask_before_{};
  mutable std::mutex mutex_;
  mutable std::condition_variable arrived_;
  int signal_number_ = 0;  ///< 0: none so far
  bool closing_ = false;
  std::function<void()> callback_;
  std::thread calling_;  ///< runs callback_
  std::thread watcher_;
};

/// Between fork and exec: another program has no use for what this one blocks and ignores.
/// Async-signal-safe.
void restore_signals();

}  // namespace raytracer::client

// SIGTERM and SIGINT: no new work, what runs is finished and answered, what jobs have made is
// fetched, then the end. A second signal, or the times that config.h says, end the patience.
#pragma once

#include <signal.h>

#include <atomic>
#include <thread>

#include "server/listener.h"
#include "server/services.h"

namespace raytracer {

/// Blocks SIGTERM and SIGINT in this thread and all that it starts from now on, so that they wait
/// for Shutdown, and ignores SIGPIPE.
void block_signals();

/// Waits for a signal on a thread of its own, then ends the service.
class Shutdown {
 public:
  /// Both must outlive it. block_signals() comes before any thread.
  Shutdown(Services& services, Listener& listener);
  /// Ends the waiting if no signal came.
  ~Shutdown();
  Shutdown(const Shutdown&) = delete;
  Shutdown& operator=(const Shutdown&) = delete;

 private:
  void wait_and_drain();
  void drain();

  Services& services_;
  Listener& listener_;
  std::atomic<bool> is_over_{false};  ///< the listener ended by itself
  std::thread thread_;
};

}  // namespace raytracer

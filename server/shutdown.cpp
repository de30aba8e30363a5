#include "server/shutdown.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace raytracer {
namespace {

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

bool another_signal_came() {
  sigset_t pending;
  return sigpending(&pending) == 0 &&
         (sigismember(&pending, SIGTERM) == 1 || sigismember(&pending, SIGINT) == 1);
}

}  // namespace

void block_signals() {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);  // a client that leaves while it is written to is an error code
}

Shutdown::Shutdown(Services& services, Listener& listener)
    : services_(services), listener_(listener), thread_([this] { wait_and_drain(); }) {}

Shutdown::~Shutdown() {
  is_over_ = true;
  pthread_kill(thread_.native_handle(), SIGINT);  // stays pending if the thread has ended
  thread_.join();
}

void Shutdown::wait_and_drain() {
  const sigset_t signals = ending_signals();
  int received = 0;
  while (sigwait(&signals, &received) != 0) {
  }
  if (!is_over_) drain();
}

void Shutdown::drain() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds between_looks{20};
  constexpr std::chrono::milliseconds no_time{0};
  constexpr std::chrono::seconds to_answer{10};

  // Without a delay readiness ends with the refusal: who is told "draining" is not told "full".
  if (const std::chrono::milliseconds delay{services_.config.drain_delay_ms}; delay > no_time) {
    services_.admission.announce_close();
    const auto closing = Clock::now() + delay;
    while (Clock::now() < closing && !another_signal_came())
      std::this_thread::sleep_for(between_looks);
  }
  services_.log.note("shutting down: no new work, waiting for what runs");
  services_.admission.close();
  const auto end = Clock::now() + time_to_finish;
  while (!services_.admission.wait_until_empty(between_looks))
    if (Clock::now() > end || another_signal_came()) services_.admission.stop_running();
  // Until then it took tasks: those of its own clients' renders, if nobody else does.
  if (services_.cluster)
    services_.cluster->drain(std::max(
        std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()), no_time));
  while (services_.jobs().await_fetch(time_to_fetch) && !another_signal_came())
    std::this_thread::sleep_for(between_looks);
  services_.log.wait_until_empty(to_answer);
  listener_.stop();
}

}  // namespace raytracer

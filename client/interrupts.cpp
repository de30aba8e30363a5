#include "client/interrupts.h"

#include <pthread.h>
#include <unistd.h>

#include <utility>

#include "client/failure.h"

namespace raytracer::client {

Interrupts::Interrupts() {
  sigemptyset(&signals_);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, number);
  pthread_sigmask(SIG_BLOCK, &signals_, &mask_before_);
  watcher_ = std::thread([this] { watch(); });
}

Interrupts::~Interrupts() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  pthread_kill(watcher_.native_handle(), SIGHUP);  // ends its sigwait
  watcher_.join();
  on_signal(nullptr);
  pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

void Interrupts::check() const {
  const std::lock_guard lock(mutex_);
  if (signal_number_ != 0) throw Interrupted(signal_number_);
}

void Interrupts::sleep(std::chrono::microseconds duration) const {
  std::unique_lock lock(mutex_);
  if (arrived_.wait_for(lock, duration, [this] { return signal_number_ != 0; }))
    throw Interrupted(signal_number_);
}

void Interrupts::on_signal(std::function<void()> callback) {
  std::thread ending;
  {
    const std::lock_guard lock(mutex_);
    callback_ = std::move(callback);
    ending = std::move(calling_);
  }
  if (ending.joinable()) ending.join();
}

void Interrupts::watch() {
  for (;;) {
    int number = 0;
    sigwait(&signals_, &number);
    const std::lock_guard lock(mutex_);
    if (closing_) return;
    if (signal_number_ != 0) _exit(128 + number);
    signal_number_ = number;
    arrived_.notify_all();
    // Not on this thread: httplib's stop() waits for a connection attempt to time out, and the
    // second signal is to be heard meanwhile.
    if (callback_) calling_ = std::thread(callback_);
  }
}

void restore_signals() {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
}

}  // namespace raytracer::client

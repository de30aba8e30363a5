#include "server/disconnect_watch.h"

#include <chrono>
#include <utility>

namespace raytracer {

DisconnectWatch::DisconnectWatch() : thread_([this] { poll(); }) {}

DisconnectWatch::~DisconnectWatch() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void DisconnectWatch::poll() {
  constexpr std::chrono::milliseconds interval{50};
  std::unique_lock lock(mutex_);
  for (;;) {
    // Again after a watch that woke this thread and was over before it ran: the next must wake it.
    changed_.wait(lock, [&] {
      is_idle_ = !closing_ && registered_.empty();
      return !is_idle_;
    });
    if (changed_.wait_for(lock, interval, [&] { return closing_; })) return;
    for (Registration* const registration : registered_) registration->poll();
  }
}

void DisconnectWatch::Registration::poll() {
  if (!on_disconnect_) return;
  if (!socket_) socket_ = find_socket(connection_);
  // Of a connection that was reset the system does not know the ends any more.
  if (*socket_ < 0 || client_has_disconnected(*socket_)) std::exchange(on_disconnect_, nullptr)();
}

DisconnectWatch::Registration::Registration(DisconnectWatch& watch, ConnectionEndpoints connection,
                                            std::function<void()> on_disconnect)
    : watch_(watch), connection_(std::move(connection)), on_disconnect_(std::move(on_disconnect)) {
  const std::scoped_lock lock(watch_.mutex_);
  watch_.registered_.push_back(this);
  if (std::exchange(watch_.is_idle_, false)) watch_.changed_.notify_all();
}

DisconnectWatch::Registration::~Registration() {
  const std::scoped_lock lock(watch_.mutex_);
  std::erase(watch_.registered_, this);
}

}  // namespace raytracer

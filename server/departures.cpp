#include "server/departures.h"

#include <chrono>
#include <utility>

namespace raytracer {

Departures::Departures() : thread_([this] { look(); }) {}

Departures::~Departures() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Departures::look() {
  constexpr std::chrono::milliseconds interval{50};
  std::unique_lock lock(mutex_);
  for (;;) {
    // Again after a watch that woke this thread and was over before it ran: the next must wake it.
    changed_.wait(lock, [&] {
      is_idle_ = !closing_ && watched_.empty();
      return !is_idle_;
    });
    if (changed_.wait_for(lock, interval, [&] { return closing_; })) return;
    for (Watch* const watch : watched_) watch->look();
  }
}

void Departures::Watch::look() {
  if (!left_) return;
  if (!socket_) socket_ = find_socket(connection_);
  // Of a connection that was reset the system does not know the ends any more.
  if (*socket_ < 0 || client_has_left(*socket_)) std::exchange(left_, nullptr)();
}

Departures::Watch::Watch(Departures& departures, ConnectionEnds connection,
                         std::function<void()> left)
    : departures_(departures), connection_(std::move(connection)), left_(std::move(left)) {
  const std::scoped_lock lock(departures_.mutex_);
  departures_.watched_.push_back(this);
  if (std::exchange(departures_.is_idle_, false)) departures_.changed_.notify_all();
}

Departures::Watch::~Watch() {
  const std::scoped_lock lock(departures_.mutex_);
  std::erase(departures_.watched_, this);
}

}  // namespace raytracer

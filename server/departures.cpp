#include "server/departures.h"

#include <chrono>
#include <utility>

#include "server/connection.h"

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
    changed_.wait(lock, [&] { return closing_ || !watched_.empty(); });
    if (changed_.wait_for(lock, interval, [&] { return closing_; })) return;
    for (Watch* const watch : watched_)
      if (watch->left_ && client_has_left(watch->socket_)) std::exchange(watch->left_, nullptr)();
  }
}

Departures::Watch::Watch(Departures& departures, int socket, std::function<void()> left)
    : departures_(departures), socket_(socket), left_(std::move(left)) {
  const std::scoped_lock lock(departures_.mutex_);
  departures_.watched_.push_back(this);
  departures_.changed_.notify_all();
}

Departures::Watch::~Watch() {
  const std::scoped_lock lock(departures_.mutex_);
  std::erase(departures_.watched_, this);
}

}  // namespace raytracer

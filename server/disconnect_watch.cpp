#include "server/disconnect_watch.h"

#include <chrono>
#include <utility>

#include "server/connection.h"

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

DisconnectWatch::Registration DisconnectWatch::watch(const httplib::Request& request,
                                                     std::function<void()> on_disconnect) {
  const std::scoped_lock lock(mutex_);
  const auto client = clients_.insert(clients_.end(), {request, std::move(on_disconnect)});
  if (std::exchange(is_idle_, false)) changed_.notify_all();
  return {this, [this, client](const void*) {
            const std::scoped_lock end(mutex_);
            clients_.erase(client);
          }};
}

void DisconnectWatch::poll() {
  constexpr std::chrono::milliseconds interval{50};
  std::unique_lock lock(mutex_);
  for (;;) {
    is_idle_ = clients_.empty();
    changed_.wait(lock, [&] { return closing_ || !is_idle_; });
    if (changed_.wait_for(lock, interval, [&] { return closing_; })) return;
    for (Client& client : clients_) {
      if (!client.on_disconnect) continue;
      if (!client.socket) client.socket = find_socket(client.request);
      // Of a connection that was reset the system does not know the ends any more: there is none.
      if (*client.socket < 0 || client_has_disconnected(*client.socket))
        std::exchange(client.on_disconnect, nullptr)();
    }
  }
}

}  // namespace raytracer

#include "server/connection.h"

#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

namespace raytracer {
namespace {

#ifdef POLLRDHUP
constexpr short end_of_input = POLLRDHUP;  // also seen behind input that was not read yet
#else
constexpr short end_of_input = 0;
#endif

using NameFunction = int (*)(int, sockaddr*, socklen_t*);

/// One end of a TCP connection.
struct End {
  sockaddr_storage storage{};
  socklen_t length = sizeof storage;

  const sockaddr* address() const { return reinterpret_cast<const sockaddr*>(&storage); }

  int port() const {
    return ntohs(storage.ss_family == AF_INET
                     ? reinterpret_cast<const sockaddr_in*>(&storage)->sin_port
                     : reinterpret_cast<const sockaddr_in6*>(&storage)->sin6_port);
  }

  /// In figures; empty if the system has none.
  std::string host() const {
    std::array<char, NI_MAXHOST> host{};
    if (getnameinfo(address(), length, host.data(), host.size(), nullptr, 0, NI_NUMERICHOST) != 0)
      return {};
    return host.data();
  }
};

/// What getpeername or getsockname tells; nothing if the descriptor is no TCP connection.
std::optional<End> end_of(int socket, NameFunction name_of_end) {
  End end;
  if (name_of_end(socket, reinterpret_cast<sockaddr*>(&end.storage), &end.length) != 0) return {};
  if (end.storage.ss_family != AF_INET && end.storage.ss_family != AF_INET6) return {};
  return end;
}

bool end_is(int socket, NameFunction name_of_end, const std::string& address, int port) {
  const std::optional<End> end = end_of(socket, name_of_end);
  return end && end->port() == port && end->host() == address;  // the text last: it takes longest
}

/// How many descriptors the process may open, or `most` if that is less.
std::size_t descriptor_limit(std::size_t most) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return most;
  return std::min<std::size_t>(limit.rlim_cur, most);
}

/// The first descriptor that this process has open and that visit(descriptor) is true of, or -1.
template <typename Visit>
int find_descriptor(const Visit& visit) {
  // Not by counting up to the limit: it may be a million, and a client that has left is never
  // found.
  std::error_code error;
  std::filesystem::directory_iterator entry("/dev/fd", error);
  for (const std::filesystem::directory_iterator end; !error && entry != end;
       entry.increment(error))
    if (const int descriptor = std::atoi(entry->path().filename().c_str()); visit(descriptor))
      return descriptor;
  if (!error) return -1;
  // Without a descriptor left to list them by, or without the list.
  const auto limit = static_cast<int>(descriptor_limit(65'536));
  for (int descriptor = 0; descriptor < limit; ++descriptor)
    if (visit(descriptor)) return descriptor;
  return -1;
}

}  // namespace

std::size_t most_connections() { return descriptor_limit(2048); }

int find_socket(const httplib::Request& request) {
  return find_descriptor([&](int socket) {
    return end_is(socket, getpeername, request.remote_addr, request.remote_port) &&
           end_is(socket, getsockname, request.local_addr, request.local_port);
  });
}

void shut_down_connections(int local_port) {
  find_descriptor([&](int socket) {
    const std::optional<End> local = end_of(socket, getsockname);
    if (local && local->port() == local_port && end_of(socket, getpeername))
      shutdown(socket, SHUT_RDWR);
    return false;
  });
}

bool client_has_disconnected(int socket) {
  if (socket < 0) return false;
  pollfd state{socket, static_cast<short>(POLLIN | end_of_input), 0};
  if (poll(&state, 1, 0) <= 0) return false;
  if ((state.revents & (POLLERR | POLLHUP | POLLNVAL | end_of_input)) != 0) return true;
  char byte = 0;
  return (state.revents & POLLIN) != 0 && recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

void linger(int socket) {
  using Clock = std::chrono::steady_clock;
  constexpr int silence_ms = 1000;
  if (socket < 0) return;
  shutdown(socket, SHUT_WR);
  const auto end = Clock::now() + std::chrono::seconds(5);
  std::array<char, 65'536> unread;
  while (Clock::now() < end) {
    pollfd state{socket, POLLIN, 0};
    if (poll(&state, 1, silence_ms) <= 0) break;
    if (recv(socket, unread.data(), unread.size(), MSG_DONTWAIT) <= 0) break;
  }
  // What came too late must not be taken for the next request.
  shutdown(socket, SHUT_RDWR);
}

}  // namespace raytracer

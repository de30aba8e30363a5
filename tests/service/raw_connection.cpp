#include "tests/service/raw_connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>

#include "tests/process/patience.h"

namespace raytracer::test {

#ifdef MSG_NOSIGNAL
constexpr int send_flags = MSG_NOSIGNAL;
#else
constexpr int send_flags = 0;
#endif

RawConnection::RawConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket_);
    throw std::runtime_error("nobody listens on port " + std::to_string(port));
  }
  const timeval limit{30, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
#ifdef SO_NOSIGPIPE
  const int yes = 1;
  ::setsockopt(socket_, SOL_SOCKET, SO_NOSIGPIPE, &yes, sizeof yes);
#endif
}

RawConnection::~RawConnection() { ::close(socket_); }

bool RawConnection::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), send_flags);
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool RawConnection::read_some() {
  pollfd readable{socket_, POLLIN, 0};
  if (ended_ || ::poll(&readable, 1, 5) <= 0) return false;
  char buffer[65536];
  const ssize_t count = ::recv(socket_, buffer, sizeof buffer, 0);
  if (count <= 0)
    ended_ = true;
  else
    received_.append(buffer, static_cast<std::size_t>(count));
  return count > 0;
}

/// Also if the end comes first.
template <typename Predicate>
bool RawConnection::reads_until(Predicate holds, std::chrono::milliseconds limit) {
  eventually(
      [&] {
        while (!holds() && read_some()) {
        }
        return ended_ || holds();
      },
      limit);
  return holds();
}

bool RawConnection::receives(std::string_view text, std::chrono::milliseconds limit) {
  return reads_until([&] { return received_.find(text) != std::string::npos; }, limit);
}

bool RawConnection::receives(std::size_t byte_count, std::chrono::milliseconds limit) {
  return reads_until([&] { return received_.size() >= byte_count; }, limit);
}

bool RawConnection::ends(std::chrono::milliseconds limit) {
  return reads_until([&] { return ended_; }, limit);
}

int count_answers(std::string_view bytes) {
  constexpr std::string_view protocol = "HTTP/1.1 ";
  int count = 0;
  for (std::size_t at = bytes.find(protocol); at != std::string_view::npos;
       at = bytes.find(protocol, at + 1)) {
    const std::string_view status = bytes.substr(at + protocol.size(), 1);
    if (status >= "1" && status <= "5") ++count;  // and not a sentence about HTTP/1.1
  }
  return count;
}

}  // namespace raytracer::test

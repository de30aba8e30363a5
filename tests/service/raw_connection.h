// A TCP connection to the server, for requests that no HTTP library would send.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace raytracer::test {

class RawConnection {
 public:
  /// Throws std::runtime_error if nobody listens there.
  explicit RawConnection(int port);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  /// False if the server has closed before it took all.
  bool send(std::string_view bytes) const;

  /// Reads until `text` has come; false if it has not, and will not, within patience(limit).
  bool receives(std::string_view text, std::chrono::milliseconds limit);

  /// Reads until so many bytes have come; false as above.
  bool receives(std::size_t byte_count, std::chrono::milliseconds limit);

  /// Reads until the server closes; false if it does not within patience(limit).
  bool ends(std::chrono::milliseconds limit);

  /// What came so far, since it was forgotten.
  const std::string& received() const { return received_; }
  void forget() { received_.clear(); }

 private:
  bool read_some();
  template <typename Predicate>
  bool reads_until(Predicate holds, std::chrono::milliseconds limit);

  int socket_ = -1;
  bool ended_ = false;
  std::string received_;
};

/// How many HTTP answers begin in `bytes`.
int count_answers(std::string_view bytes);

}  // namespace raytracer::test

// A raytracer-server of the client's own, for when no other is named.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <string>

#include "client/interrupts.h"

namespace raytracer::client {

/// Runs from construction to destruction on a free port of the loopback interface. On Linux the
/// kernel ends it too when the client is killed.
class PrivateDaemon {
 public:
  /// Returns when the daemon listens. Throws ServerError if there is none beside the client and
  /// none on PATH, or if it does not start, with what it said.
  explicit PrivateDaemon(const Interrupts& interrupts);
  /// Asks it to end (SIGTERM) and makes it (SIGKILL) after two seconds.
  ~PrivateDaemon();
  PrivateDaemon(const PrivateDaemon&) = delete;
  PrivateDaemon& operator=(const PrivateDaemon&) = delete;

  /// "http://127.0.0.1:40123"
  const std::string& url() const { return url_; }

  /// How and with which last words it has ended by itself; empty while it runs.
  std::string exit_report();

 private:
  void start();
  void wait_until_listening(const Interrupts& interrupts);
  void stop();
  bool has_ended();
  std::string last_words() const;

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> output_;  ///< all that it prints, unnamed
  pid_t pid_ = -1;
  int wait_status_ = 0;
  bool ended_ = false;
  std::string url_;
};

}  // namespace raytracer::client

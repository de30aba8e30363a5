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
  /// Returns at once: it starts while the client reads its scene.
  PrivateDaemon();
  /// Kills it: nobody else knows it, and nothing that it has outlives it.
  ~PrivateDaemon();
  PrivateDaemon(const PrivateDaemon&) = delete;
  PrivateDaemon& operator=(const PrivateDaemon&) = delete;

  /// "http://127.0.0.1:40123", as soon as it listens there. Throws ServerError if there is none
  /// beside the client and none on PATH, or if it does not start, with what it said.
  std::string wait_until_listening(const Interrupts& interrupts);

  /// How and with which last words it has ended by itself; empty while it runs.
  std::string exit_report();

 private:
  void start();
  bool has_ended();
  std::string last_words() const;

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> output_;  ///< all that it prints, unnamed
  pid_t pid_ = -1;
  int wait_status_ = 0;
  bool ended_ = false;
};

}  // namespace raytracer::client

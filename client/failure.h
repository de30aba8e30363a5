// What can go wrong, by the exit status that it leads to.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

namespace raytracer::client {

/// The scene or the arguments are wrong: exit status 1. what() has one line for each error.
class InputError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The server could not be reached or failed: exit status 2.
class ServerError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// It has nothing of that name, or not any more.
class NotFound : public ServerError {
  using ServerError::ServerError;
};

/// It has too much to do to take more now.
class ServerBusy : public ServerError {
 public:
  ServerBusy(const std::string& what, std::chrono::seconds retry_after)
      : ServerError(what), retry_after_(retry_after) {}
  std::chrono::seconds retry_after() const { return retry_after_; }

 private:
  std::chrono::seconds retry_after_;
};

/// A signal asks the client to end: exit status 128 + signal, as a shell counts.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(int signal_number)
      : std::runtime_error("interrupted"), signal_number_(signal_number) {}
  int signal_number() const { return signal_number_; }

 private:
  int signal_number_;
};

}  // namespace raytracer::client

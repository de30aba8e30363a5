// Other programs, started, watched and ended: never longer than a limit, and never left behind.
//
// Standard output and error go into unnamed files, so that a program which says much never waits
// for its reader. RAYTRACER_* variables of whoever runs the tests do not reach the program.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace raytracer::test {

struct Command {
  std::filesystem::path program;  ///< looked up on PATH if it has no slash
  std::vector<std::string> arguments{};
  std::string input{};                               ///< standard input, then its end
  std::map<std::string, std::string> environment{};  ///< over what the test has itself
  std::filesystem::path directory{};                 ///< to work in; empty: the test's own
};

/// How a program ended. An exit status, or 128 + the signal, as a shell counts.
struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

/// Descriptors that become a child's standard input, output and error. A child that `leads` has
/// its standard input as its controlling terminal.
struct StandardStreams {
  int in = -1;
  int out = -1;
  int err = -1;
  bool leads = false;
};

/// Starts the program; a missing one ends with status 127. On Linux it dies with the thread that
/// started it. Throws std::runtime_error if the system refuses.
pid_t start(const Command& command, const StandardStreams& streams);

/// A program that runs while the test goes on; killed at the end if it still does.
class Process {
 public:
  explicit Process(const Command& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return pid_; }
  void signal(int number) const;

  /// What it has said so far.
  std::string out() const;
  std::string err() const;

  /// Its status once it has ended by itself, now and for any later call; nothing if that is not
  /// so within patience(limit).
  std::optional<int> wait(std::chrono::milliseconds limit);

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  File in_;
  File out_;
  File err_;
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Runs the program to its end. Throws std::runtime_error, with what it said, if that takes longer
/// than patience(limit).
Outcome run(const Command& command,
            std::chrono::milliseconds limit = std::chrono::milliseconds(30'000));

/// The status of a waitpid() result as a shell counts.
int shell_status(int wait_status);

}  // namespace raytracer::test

// A program in a terminal of the test's making: what a person would see, and the keys they press.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "tests/process/program.h"

namespace raytracer::test {

class PseudoTerminal {
 public:
  /// Starts the program with the terminal as standard input, output, error and controlling
  /// terminal. Throws std::runtime_error if the system has no terminal left.
  PseudoTerminal(const Command& command, int columns, int rows);
  /// Whether this system has pseudo-terminals: a chroot without /dev/pts has none.
  static bool is_available();
  /// Kills the program if it still runs.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Presses keys; "\x03" is Ctrl-C.
  void type(std::string_view keys) const;

  /// Reads until `text` has appeared; false if it has not within patience(limit).
  bool shows(std::string_view text, std::chrono::milliseconds limit);

  /// Reads until the program has ended: its status as a shell counts, or nothing if it has not
  /// ended within patience(limit).
  std::optional<int> wait(std::chrono::milliseconds limit);

  /// All that was shown so far, lines ended by "\r\n".
  const std::string& screen() const { return screen_; }

  pid_t id() const { return pid_; }

 private:
  void read_some();

  int master_ = -1;
  pid_t pid_ = -1;
  std::optional<int> status_;
  std::string screen_;
};

}  // namespace raytracer::test

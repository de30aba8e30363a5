#include "tests/process/pseudo_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "tests/process/patience.h"

namespace raytracer::test {

bool PseudoTerminal::is_available() {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  const bool available = terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0;
  if (terminal >= 0) ::close(terminal);
  return available;
}

PseudoTerminal::PseudoTerminal(const Command& command, int columns, int rows)
    : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
  if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0)
    throw std::runtime_error("cannot open a pseudo-terminal");
  ::fcntl(master_, F_SETFD, FD_CLOEXEC);
  const int terminal = ::open(::ptsname(master_), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0) throw std::runtime_error("cannot open the pseudo-terminal's other side");
  winsize size{};
  size.ws_col = static_cast<unsigned short>(columns);
  size.ws_row = static_cast<unsigned short>(rows);
  ::ioctl(terminal, TIOCSWINSZ, &size);
  Command with_terminal = command;
  with_terminal.environment.emplace("TERM", "xterm-256color");
  pid_ = start(with_terminal, {terminal, terminal, terminal, true});
  ::close(terminal);
}

PseudoTerminal::~PseudoTerminal() {
  if (!status_) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(master_);
}

void PseudoTerminal::type(std::string_view keys) const {
  if (::write(master_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
    throw std::runtime_error("the pseudo-terminal takes no keys");
}

void PseudoTerminal::read_some() {
  pollfd readable{master_, POLLIN, 0};
  while (::poll(&readable, 1, 2) > 0 && (readable.revents & POLLIN) != 0) {
    char buffer[65536];
    const ssize_t count = ::read(master_, buffer, sizeof buffer);
    if (count <= 0) return;
    screen_.append(buffer, static_cast<std::size_t>(count));
  }
}

bool PseudoTerminal::shows(std::string_view text, std::chrono::milliseconds limit) {
  return eventually(
      [&] {
        read_some();
        return screen_.find(text) != std::string::npos;
      },
      limit);
}

std::optional<int> PseudoTerminal::wait(std::chrono::milliseconds limit) {
  eventually(
      [&] {
        if (status_) return true;
        read_some();
        int wait_status = 0;
        if (::waitpid(pid_, &wait_status, WNOHANG) != pid_) return false;
        status_ = shell_status(wait_status);
        read_some();  // its last words
        return true;
      },
      limit);
  return status_;
}

}  // namespace raytracer::test

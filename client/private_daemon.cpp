// fork and exec rather than posix_spawn: only the child itself can ask the kernel to be ended with
// its parent. Between the two it calls nothing but async-signal-safe functions.
#include "client/private_daemon.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sys/prctl.h>
#endif
#ifdef __APPLE__
#include <mach-o/dyld.h>
extern char** environ;
#endif

#include "client/failure.h"

namespace raytracer::client {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr const char* daemon_name = "raytracer-server";
constexpr milliseconds start_limit{15000};
constexpr milliseconds stop_limit{2000};

/// The directory of the client's own executable; empty if the system does not say.
fs::path own_directory() {
  std::error_code error;
#ifdef __APPLE__
  std::array<char, 4096> buffer{};
  auto size = static_cast<std::uint32_t>(buffer.size());
  if (_NSGetExecutablePath(buffer.data(), &size) != 0) return {};
  const fs::path self = fs::canonical(buffer.data(), error);
#else
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
#endif
  return error ? fs::path() : self.parent_path();
}

/// The daemon beside the client, or the first on PATH.
fs::path find_daemon() {
  std::vector<fs::path> directories;
  if (fs::path own = own_directory(); !own.empty()) directories.push_back(std::move(own));
  const char* path = std::getenv("PATH");
  std::istringstream list(path == nullptr ? "" : path);
  for (std::string directory; std::getline(list, directory, ':');)
    directories.emplace_back(directory.empty() ? "." : directory);
  for (const fs::path& directory : directories) {
    fs::path candidate = directory / daemon_name;
    std::error_code error;
    if (fs::is_regular_file(candidate, error) && ::access(candidate.c_str(), X_OK) == 0)
      return candidate;
  }
  throw ServerError(
      fmt::format("there is no {} beside this program and none on PATH: build or install it, or "
                  "name a running one with --server or RAYTRACER_SERVER",
                  daemon_name));
}

/// The environment without what would make the daemon listen elsewhere or ask for a token.
std::vector<char*> daemon_environment() {
  std::vector<char*> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view name = *entry;
    if (!name.starts_with("RAYTRACER_HOST=") && !name.starts_with("RAYTRACER_PORT=") &&
        !name.starts_with("RAYTRACER_TOKEN="))
      kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
}

/// The two ends of a pipe, closed at the end; no other child gets them.
struct Pipe {
  std::array<int, 2> ends{-1, -1};

  Pipe() {
    if (::pipe(ends.data()) != 0)
      throw ServerError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  ~Pipe() {
    ::close(ends[0]);
    close_write_end();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_write_end() {
    if (ends[1] >= 0) ::close(ends[1]);
    ends[1] = -1;
  }
};

/// In the child: becomes the daemon, or ends with status 127.
[[noreturn]] void become_daemon(const char* path, char* const* environment, int output, int log,
                                pid_t parent) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it has died before prctl
#else
  static_cast<void>(parent);
#endif
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  const std::array<const char*, 6> arguments{path, "--host", "127.0.0.1", "--port", "0", nullptr};
  ::execve(path, const_cast<char* const*>(arguments.data()), environment);
  ::_exit(127);
}

std::string describe(int wait_status) {
  if (WIFSIGNALED(wait_status))
    return fmt::format("was ended by signal {} ({})", WTERMSIG(wait_status),
                       strsignal(WTERMSIG(wait_status)));
  return fmt::format("ended with status {}", WEXITSTATUS(wait_status));
}

}  // namespace

PrivateDaemon::PrivateDaemon(const Interrupts& interrupts) : log_(std::tmpfile(), &std::fclose) {
  if (!log_)
    throw ServerError(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
  const std::string path = find_daemon().string();
  const std::vector<char*> environment = daemon_environment();
  Pipe output;
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) throw ServerError(fmt::format("cannot start {}: {}", path, std::strerror(errno)));
  if (pid_ == 0)
    become_daemon(path.c_str(), environment.data(), output.ends[1], ::fileno(log_.get()), parent);
  output.close_write_end();
  try {
    url_ = wait_until_listening(output.ends[0], interrupts);
    if (url_.empty()) {
      const std::string end = exit_report();
      throw ServerError(fmt::format("{} did not start: {}", path,
                                    end.empty() ? "it did not say that it listens" : end));
    }
  } catch (...) {
    stop();
    throw;
  }
}

PrivateDaemon::~PrivateDaemon() { stop(); }

std::string PrivateDaemon::wait_until_listening(int output, const Interrupts& interrupts) {
  constexpr std::string_view greeting = "listening on ";
  const auto deadline = steady_clock::now() + start_limit;
  std::string said;
  while (steady_clock::now() < deadline) {
    interrupts.check();
    pollfd readable{output, POLLIN, 0};
    if (::poll(&readable, 1, 50) <= 0) continue;
    std::array<char, 512> buffer{};
    const ssize_t count = ::read(output, buffer.data(), buffer.size());
    if (count <= 0) {
      has_ended(true);  // it has closed its output: it ends, and says on its log why
      return {};
    }
    said.append(buffer.data(), static_cast<std::size_t>(count));
    const std::size_t begin = said.find(greeting);
    const std::size_t end = begin == said.npos ? said.npos : said.find('\n', begin);
    if (end != said.npos)
      return said.substr(begin + greeting.size(), end - begin - greeting.size());
  }
  return {};
}

bool PrivateDaemon::has_ended(bool wait) {
  const auto deadline = steady_clock::now() + stop_limit;
  while (!ended_ && pid_ > 0) {
    ended_ = ::waitpid(pid_, &wait_status_, WNOHANG) != 0;
    if (ended_ || !wait || steady_clock::now() > deadline) break;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return ended_;
}

void PrivateDaemon::stop() {
  if (pid_ <= 0 || has_ended(false)) return;
  ::kill(pid_, SIGTERM);
  if (has_ended(true)) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, &wait_status_, 0);
  ended_ = true;
}

std::string PrivateDaemon::exit_report() {
  if (!has_ended(false)) return {};
  constexpr long most_bytes = 1000;
  std::string log;
  std::fseek(log_.get(), 0, SEEK_END);
  const long size = std::ftell(log_.get());
  std::fseek(log_.get(), std::max(0L, size - most_bytes), SEEK_SET);
  for (int c = std::fgetc(log_.get()); c != EOF; c = std::fgetc(log_.get()))
    log += static_cast<char>(c);
  while (log.ends_with('\n')) log.pop_back();
  return fmt::format("it {}{}{}", describe(wait_status_), log.empty() ? "" : " and said:\n", log);
}

}  // namespace raytracer::client

// fork and exec rather than posix_spawn: only the child itself can ask the kernel to be ended with
// its parent. Between the two it calls nothing but async-signal-safe functions.
#include "client/private_daemon.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
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

#ifdef __linux__
#include <sys/prctl.h>
#endif
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

#include "client/failure.h"
#include "client/interrupts.h"

namespace raytracer::client {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr const char* daemon_name = "raytracer-server";
constexpr milliseconds start_limit{15000};
constexpr milliseconds pause{1};
constexpr int not_found = 127;  // as shells say it

/// Variables for a server that others are to reach, or that works with others. With a token it
/// would ask the client for one.
constexpr std::array public_variables{
    "RAYTRACER_HOST",         "RAYTRACER_PORT",   "RAYTRACER_TOKEN",      "RAYTRACER_ALLOW_ORIGIN",
    "RAYTRACER_NATS",         "RAYTRACER_WORKER", "RAYTRACER_NO_WORK",    "RAYTRACER_SHARE_FROM",
    "RAYTRACER_TASK_TIMEOUT", "RAYTRACER_KEEP",   "RAYTRACER_MAX_STORED", "RAYTRACER_DRAIN_DELAY"};

/// Where the daemon is if it is beside the client's own executable; empty if the system does not
/// say where that is.
std::string path_beside_client() {
  std::error_code error;
#ifdef __APPLE__
  std::array<char, 4096> buffer{};
  auto size = static_cast<std::uint32_t>(buffer.size());
  if (_NSGetExecutablePath(buffer.data(), &size) != 0) return {};
  const fs::path self = fs::canonical(buffer.data(), error);
#else
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
#endif
  return error ? "" : (self.parent_path() / daemon_name).string();
}

/// In the child: becomes the daemon, or ends with not_found.
[[noreturn]] void become_daemon(const char* beside_client, int output, pid_t parent) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(not_found);  // it has died before prctl
#else
  static_cast<void>(parent);
#endif
  restore_signals();
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  for (const char* const path : {beside_client, daemon_name})
    ::execlp(path, daemon_name, "--host", "127.0.0.1", "--port", "0", "--quiet", nullptr);
  ::_exit(not_found);
}

std::string describe(int wait_status) {
  if (WIFSIGNALED(wait_status))
    return fmt::format("was ended by signal {} ({})", WTERMSIG(wait_status),
                       strsignal(WTERMSIG(wait_status)));
  return fmt::format("ended with status {}", WEXITSTATUS(wait_status));
}

}  // namespace

PrivateDaemon::PrivateDaemon() : output_(std::tmpfile(), &std::fclose) {
  if (!output_)
    throw ServerError(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
  start();
}

PrivateDaemon::~PrivateDaemon() {
  if (has_ended()) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, &wait_status_, 0);
}

void PrivateDaemon::start() {
  for (const char* const name : public_variables) ::unsetenv(name);
  // Limits are against others, of which it has none; whoever sets them means it.
  ::setenv("RAYTRACER_MAX_BODY", "2147483648", 0);
  ::setenv("RAYTRACER_MAX_OBJECTS", "100000000", 0);
  ::setenv("RAYTRACER_MAX_PIXELS", "268435456", 0);
  ::setenv("RAYTRACER_MAX_WORK", "9007199254740992", 0);
  const std::string beside_client = path_beside_client();
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become_daemon(beside_client.c_str(), ::fileno(output_.get()), parent);
  if (pid_ < 0)
    throw ServerError(fmt::format("cannot start {}: {}", daemon_name, std::strerror(errno)));
}

std::string PrivateDaemon::wait_until_listening(const Interrupts& interrupts) {
  constexpr std::string_view greeting = "listening on ";
  const auto deadline = steady_clock::now() + start_limit;
  while (!has_ended() && steady_clock::now() < deadline) {
    const std::string said = last_words();
    const std::size_t begin = said.find(greeting);
    const std::size_t end = begin == said.npos ? said.npos : said.find('\n', begin);
    if (end != said.npos)
      return said.substr(begin + greeting.size(), end - begin - greeting.size());
    interrupts.sleep(pause);
  }
  if (ended_ && WIFEXITED(wait_status_) && WEXITSTATUS(wait_status_) == not_found)
    throw ServerError(
        fmt::format("there is no {} beside this program and none on PATH: build or install it, or "
                    "name a running one with --server or RAYTRACER_SERVER",
                    daemon_name));
  throw ServerError(fmt::format("{} did not start: {}", daemon_name,
                                ended_ ? exit_report() : "it did not say that it listens"));
}

bool PrivateDaemon::has_ended() {
  ended_ = ended_ || ::waitpid(pid_, &wait_status_, WNOHANG) != 0;
  return ended_;
}

std::string PrivateDaemon::exit_report() {
  if (!has_ended()) return {};
  std::string words = last_words();
  while (words.ends_with('\n')) words.pop_back();
  return fmt::format("it {}{}{}", describe(wait_status_), words.empty() ? "" : " and said:\n",
                     words);
}

std::string PrivateDaemon::last_words() const {
  const int file = ::fileno(output_.get());
  struct stat status {};
  ::fstat(file, &status);
  std::string words(1000, '\0');
  const off_t begin = std::max<off_t>(0, status.st_size - static_cast<off_t>(words.size()));
  // Not by seeking: the daemon writes where this would leave off.
  const ssize_t count = ::pread(file, words.data(), words.size(), begin);
  words.resize(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  return words;
}

}  // namespace raytracer::client

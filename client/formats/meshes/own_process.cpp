#include "client/formats/meshes/own_process.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

#include "client/failure.h"

namespace raytracer::client {
namespace {

constexpr char succeeded = '+';
constexpr char failed = '-';

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);  // where the system refuses, less is guarded
}

/// By the clock: another program may have half of the processor. So what waits ends, too.
unsigned clock_seconds(const ProcessLimits& limits) { return 2 * limits.seconds; }

void apply(const ProcessLimits& limits) {
  limit(RLIMIT_CORE, 0);
  // Killed at once, which both ends at one place come to, it would not say why.
  const rlimit seconds{limits.seconds, limits.seconds + 1};
  setrlimit(RLIMIT_CPU, &seconds);
  limit(RLIMIT_FSIZE, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which map terabytes
  limit(RLIMIT_AS, limits.memory_bytes);
#endif
  // For what waits instead of computing: a file that names a pipe.
  for (const int number : {SIGALRM, SIGXCPU, SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  alarm(clock_seconds(limits));
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// In the new process; does not return.
[[noreturn]] void answer(int descriptor, const ProcessLimits& limits,
                         const std::function<std::string()>& make) {
  apply(limits);
  std::string bytes;
  try {
    bytes = succeeded + make();
  } catch (const std::bad_alloc&) {
    bytes = fmt::format("{}needs more memory than {} MB", failed, limits.memory_bytes >> 20);
  } catch (const std::exception& error) {
    bytes = failed + std::string(error.what());
  } catch (...) {
    bytes = failed + std::string("cannot be read");
  }
  _exit(write_all(descriptor, bytes) ? 0 : 1);
}

std::string read_to_end(int descriptor) {
  std::string bytes;
  std::array<char, 1 << 16> room{};
  for (;;) {
    const ssize_t count = ::read(descriptor, room.data(), room.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(room.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::string in_own_process(const ProcessLimits& limits, const std::function<std::string()>& make) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0)
    throw InputError(fmt::format("no pipe to be had: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) {
    close(pipe[0]);
    answer(pipe[1], limits, make);
  }
  close(pipe[1]);
  std::string bytes = child < 0 ? "" : read_to_end(pipe[0]);
  close(pipe[0]);
  if (child < 0) throw InputError(fmt::format("no process to be had: {}", std::strerror(errno)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int signal_number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal_number == SIGXCPU || signal_number == SIGALRM)
    throw InputError(
        fmt::format("takes longer to read than {} s; is it damaged?",
                    signal_number == SIGALRM ? clock_seconds(limits) : limits.seconds));
  if (signal_number == SIGKILL)
    throw InputError("was not read to its end: the system ended its reader; is memory short?");
  if (status != 0 || bytes.empty()) throw InputError("is damaged: its reader broke off");
  const bool is_made = bytes[0] == succeeded;
  bytes.erase(0, 1);
  if (!is_made) throw InputError(bytes);
  return bytes;
}

}  // namespace raytracer::client

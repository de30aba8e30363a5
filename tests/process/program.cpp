#include "tests/process/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string_view>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "tests/process/patience.h"

#ifdef __APPLE__
extern char** environ;
#endif

namespace raytracer::test {
namespace {

/// The test's environment without RAYTRACER_*, and `over` over it.
std::vector<std::string> environment_for(const std::map<std::string, std::string>& over) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string name(text.substr(0, text.find('=')));
    if (!name.starts_with("RAYTRACER_") && !over.contains(name)) entries.emplace_back(text);
  }
  for (const auto& [name, value] : over) entries.push_back(fmt::format("{}={}", name, value));
  return entries;
}

/// Pointers as exec wants them; `texts` must outlive them.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// In the child, so nothing but async-signal-safe calls.
[[noreturn]] void become(const char* program, char* const* arguments, char* const* environment,
                         const char* directory, const StandardStreams& streams) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  if (streams.leads) {
    ::setsid();
    ::ioctl(streams.in, TIOCSCTTY, 0);
  }
  ::dup2(streams.in, STDIN_FILENO);
  ::dup2(streams.out, STDOUT_FILENO);
  ::dup2(streams.err, STDERR_FILENO);
  if (*directory != '\0' && ::chdir(directory) != 0) ::_exit(127);
  environ = const_cast<char**>(environment);
  ::execvp(program, arguments);
  ::_exit(127);
}

std::unique_ptr<std::FILE, int (*)(std::FILE*)> unnamed_file(std::string_view content) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  if (!file) throw std::runtime_error("cannot make a temporary file");
  std::fwrite(content.data(), 1, content.size(), file.get());
  std::rewind(file.get());
  ::fcntl(::fileno(file.get()), F_SETFD, FD_CLOEXEC);
  return file;
}

std::string content_of(std::FILE* file) {
  std::string content;
  char buffer[65536];
  for (;;) {
    const ssize_t count =
        ::pread(::fileno(file), buffer, sizeof buffer, static_cast<off_t>(content.size()));
    if (count <= 0) return content;
    content.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace

pid_t start(const Command& command, const StandardStreams& streams) {
  std::vector<std::string> arguments = command.arguments;
  arguments.insert(arguments.begin(), command.program.string());
  std::vector<std::string> environment = environment_for(command.environment);
  const std::vector<char*> argument_pointers = pointers_to(arguments);
  const std::vector<char*> environment_pointers = pointers_to(environment);
  const std::string directory = command.directory.string();
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error(fmt::format("cannot fork: {}", std::strerror(errno)));
  if (pid == 0)
    become(arguments[0].c_str(), argument_pointers.data(), environment_pointers.data(),
           directory.c_str(), streams);
  return pid;
}

int shell_status(int wait_status) {
  return WIFSIGNALED(wait_status) ? 128 + WTERMSIG(wait_status) : WEXITSTATUS(wait_status);
}

Process::Process(const Command& command)
    : in_(unnamed_file(command.input)), out_(unnamed_file("")), err_(unnamed_file("")) {
  pid_ = start(command, {::fileno(in_.get()), ::fileno(out_.get()), ::fileno(err_.get())});
}

Process::~Process() {
  if (status_) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Process::signal(int number) const {
  if (!status_) ::kill(pid_, number);
}

std::string Process::out() const { return content_of(out_.get()); }
std::string Process::err() const { return content_of(err_.get()); }

std::optional<int> Process::wait(std::chrono::milliseconds limit) {
  eventually(
      [&] {
        if (status_) return true;
        int wait_status = 0;
        if (::waitpid(pid_, &wait_status, WNOHANG) != pid_) return false;
        status_ = shell_status(wait_status);
        return true;
      },
      limit);
  return status_;
}

Outcome run(const Command& command, std::chrono::milliseconds limit) {
  Process process(command);
  const std::optional<int> status = process.wait(limit);
  if (!status)
    throw std::runtime_error(
        fmt::format("{} {} did not end; it said:\n{}{}", command.program.string(),
                    fmt::join(command.arguments, " "), process.out(), process.err()));
  return {*status, process.out(), process.err()};
}

}  // namespace raytracer::test

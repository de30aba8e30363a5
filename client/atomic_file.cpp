#include "client/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "client/failure.h"

namespace raytracer::client {
namespace {

namespace fs = std::filesystem;

InputError failed(const fs::path& path, const char* deed, int error) {
  return InputError(fmt::format("{}: {}: {}", path.string(), deed, std::strerror(error)));
}

/// Where the bytes belong: behind a symbolic link, the file that it points to.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

/// 0, or errno of what went wrong.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void check_writable(const fs::path& path) {
  const fs::path target = target_of(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(fmt::format("{}: is there already and is not a file", path.string()));
  const fs::path directory = target.has_parent_path() ? target.parent_path() : ".";
  if (::access(directory.c_str(), W_OK | X_OK) != 0)
    throw failed(path, fmt::format("cannot write into {}", directory.string()).c_str(), errno);
}

void write_atomically(const fs::path& path, std::string_view bytes) {
  const fs::path target = target_of(path);
  const fs::path temporary =
      fmt::format("{}.{}.part", target.string(), static_cast<long>(::getpid()));
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) throw failed(temporary, "cannot create", errno);
  int error = write_all(fd, bytes);
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw failed(temporary, "cannot write", error);
  }
  if (::rename(temporary.c_str(), target.c_str()) != 0) {
    error = errno;
    ::unlink(temporary.c_str());
    throw failed(path, "cannot put in its place", error);
  }
}

}  // namespace raytracer::client

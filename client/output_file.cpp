#include "client/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "client/failure.h"
#include "client/formats/ascii.h"

namespace raytracer::client {
namespace {

namespace fs = std::filesystem;

InputError failed(const std::string& place, const char* deed) {
  return InputError(fmt::format("{}: cannot be {}: {}", place, deed, std::strerror(errno)));
}

/// Where the bytes belong: behind a symbolic link, the file that it points to.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

bool write_all(std::FILE* file, std::string_view bytes) {
  return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
}

}  // namespace

std::string OutputFile::ending() const { return lower_case(path.extension().string()); }

void OutputFile::check_writable() const {
  const fs::path target = target_of(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(fmt::format("{}: is there already and is not a file", path.string()));
  const fs::path directory = target.has_parent_path() ? target.parent_path() : ".";
  if (::access(directory.c_str(), W_OK | X_OK) != 0) throw failed(path.string(), "written");
}

void OutputFile::write(std::string_view bytes) const {
  const fs::path target = target_of(path);
  const std::string part = fmt::format("{}.{}.part", target.string(), ::getpid());
  std::FILE* const file = std::fopen(part.c_str(), "wbx");
  if (!file) throw failed(path.string(), "written");
  const bool is_written = write_all(file, bytes);
  if (std::fclose(file) == 0 && is_written && std::rename(part.c_str(), target.c_str()) == 0)
    return;
  const InputError error = failed(path.string(), "written");
  ::unlink(part.c_str());
  throw error;
}

void write_to_standard_output(std::string_view bytes) {
  if (!write_all(stdout, bytes)) throw failed("standard output", "written");
}

}  // namespace raytracer::client

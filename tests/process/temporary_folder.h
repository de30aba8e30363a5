// A folder of a test's own that is gone afterwards.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace raytracer::test {

class TemporaryFolder {
 public:
  /// Throws std::runtime_error if the system gives none.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  /// Writes a file inside and returns its path.
  std::filesystem::path write(std::string_view name, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

/// The file's bytes. Throws std::runtime_error if it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace raytracer::test

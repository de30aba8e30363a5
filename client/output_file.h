// A file that appears whole or not at all: written beside its place under another name, then
// renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace raytracer::client {

struct OutputFile {
  std::filesystem::path path;

  /// ".png" of "picture.PNG"
  std::string ending() const;

  /// Finds out early what would make write() fail: a directory that is missing or may not be
  /// written to, a target that is not a file. Throws InputError.
  void check_writable() const;

  /// Replaces or creates the file; a symbolic link keeps pointing to it.
  /// Throws InputError that says what failed and where; then the old file is as it was.
  void write(std::string_view bytes) const;
};

/// Throws InputError.
void write_to_standard_output(std::string_view bytes);

}  // namespace raytracer::client

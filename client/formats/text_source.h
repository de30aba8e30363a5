// The bytes of a file, some at a time and unpacked if the file is compressed, so that nobody has to
// hold all of them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace raytracer::client {

class TextSource {
 public:
  TextSource() = default;
  virtual ~TextSource() = default;
  TextSource(const TextSource&) = delete;
  TextSource& operator=(const TextSource&) = delete;

  /// Fills the beginning of `room` and says how much; 0 at the end only. Throws InputError without
  /// the file's name if it cannot be read or unpacked.
  virtual std::size_t read(std::span<char> room) = 0;
};

/// The text outlives it.
std::unique_ptr<TextSource> source_of_text(std::string_view text);

/// Of a file, unpacked if its name ends in .gz or .zst. What unpacks to more than a hundred times
/// its size (and 32 MiB) is refused by read(). Throws InputError if it cannot be opened.
std::unique_ptr<TextSource> source_of_file(const std::string& path);

/// The path without .gz or .zst.
std::string_view without_compression(std::string_view path);

/// Whatever is left in it. Throws InputError if that is more than a gigabyte.
std::string read_all(TextSource& source);

}  // namespace raytracer::client

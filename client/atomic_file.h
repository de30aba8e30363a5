// A file appears whole or not at all: written beside its place under another name, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace raytracer::client {

/// Finds out early what would make write_atomically fail: a directory that is missing or may not
/// be written to, a target that is not a file. Throws InputError.
void check_writable(const std::filesystem::path& path);

/// Replaces or creates the file; a symbolic link keeps pointing to it.
/// Throws InputError that says what failed and where; then the old file is as it was.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace raytracer::client

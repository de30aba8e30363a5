// Where reports and pictures go.
#pragma once

#include <filesystem>
#include <string>

namespace raytracer::measure {

/// Replaces the file at `path`. Throws std::runtime_error if it cannot be written.
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace raytracer::measure

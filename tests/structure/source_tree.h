// The project's own files as texts, for tests of how they are built.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::test {

struct SourceFile {
  std::string path;  ///< from the root, with slashes: "engine/math/vec.h"
  std::string text;

  /// What it includes in quotes: "engine/math/vec.h".
  std::vector<std::string> own_includes() const;
  /// Whether it includes <header> or "header" of a library, such as "httplib.h", or a header in
  /// the folder `header` if that ends with a slash.
  bool includes_library(std::string_view header) const;
  /// The text of C++ without comments, directives and what is in quotes; its lines stay. Not for
  /// raw strings.
  std::string code() const;
};

/// The source files (C++, CMake, shell, page) in folders of the root, ordered by path; never those
/// of a build.
std::vector<SourceFile> source_files(const std::vector<std::string>& folders);

/// "engine/math/vec.h" -> "engine/math"
std::string folder_of(std::string_view path);

}  // namespace raytracer::test

#include "tests/structure/source_tree.h"

#include <algorithm>
#include <array>
#include <regex>
#include <set>

#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& path) {
  static const std::set<std::string> endings{".h",   ".cpp",  ".cmake", ".js",
                                             ".css", ".html", ".sh",    ".json"};
  return endings.contains(path.extension().string()) || path.filename() == "CMakeLists.txt";
}

}  // namespace

std::vector<std::string> SourceFile::own_includes() const {
  static const std::regex include(R"re(^\s*#\s*include\s+"([^"]+)")re", std::regex::multiline);
  std::vector<std::string> paths;
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match)
    paths.push_back(match->str(1));
  return paths;
}

bool SourceFile::includes_library(std::string_view header) const {
  static const std::regex include(R"re(^\s*#\s*include\s+[<"]([^>"]+)[>"])re",
                                  std::regex::multiline);
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match) {
    const std::string name = match->str(1);
    if (header.ends_with('/') ? name.starts_with(header) : name == header) return true;
  }
  return false;
}

std::string SourceFile::code() const {
  static const std::regex not_code(R"re(//[^\n]*|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)')re");
  static const std::regex directive(R"re(^[ \t]*#[^\n]*)re", std::regex::multiline);
  return std::regex_replace(std::regex_replace(text, not_code, ""), directive, "");
}

std::vector<SourceFile> source_files(const std::vector<std::string>& folders) {
  const fs::path root = RAYTRACER_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() && is_source(entry.path()))
        files.push_back(
            {fs::relative(entry.path(), root).generic_string(), read_file(entry.path())});
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::string folder_of(std::string_view path) {
  return std::string(path.substr(0, path.rfind('/')));
}

}  // namespace raytracer::test

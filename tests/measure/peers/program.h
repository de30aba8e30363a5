// A peer that is a program: it runs in a folder of its own, says what it took, leaves a picture.
#pragma once

#include <filesystem>
#include <string>

#include "engine/engine.h"

namespace raytracer::peers {

struct ProgramRun {
  std::string output;   ///< both streams
  double whole_ms = 0;  ///< from its start to its end
};

/// A temporary folder, removed at the end, and what runs in it.
class ProgramFolder {
 public:
  ProgramFolder();
  ~ProgramFolder();
  ProgramFolder(const ProgramFolder&) = delete;
  ProgramFolder& operator=(const ProgramFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Throws std::runtime_error with the output if the status is not 0.
  ProgramRun run(const std::string& command) const;

  /// Of 16 bits, of which rounding leaves an rmse below 1e-5. Throws std::runtime_error for
  /// anything else.
  Image read_ppm(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

/// Milliseconds, of the seconds that the group in `pattern` matches in `output`; 0 where it does
/// not occur.
double stated_ms(const std::string& output, const std::string& pattern);

/// What `command` prints, by the group in `pattern`; "unknown" without it.
std::string stated_version(const std::string& command, const std::string& pattern);

}  // namespace raytracer::peers

// POV-Ray 3.7 as a peer: its program on a scene file, its own account of the time.
//
// 16 samples are its supersampling of 4 x 4 (+A0.0 +AM1 +R4 without jitter), which adds one ray to
// each pixel.
#pragma once

#include <filesystem>
#include <string>

#include "engine/engine.h"

namespace raytracer::bench {

struct PovrayTimes {
  double parse_ms = 0;
  double bounding_ms = 0;
  double trace_ms = 0;
  double process_ms = 0;  ///< from start to end, with the picture written
};

struct PovrayRun {
  PovrayTimes times;
  ByteImage image;
};

class PovrayPeer {
 public:
  explicit PovrayPeer(std::size_t thread_count);
  ~PovrayPeer();
  PovrayPeer(const PovrayPeer&) = delete;
  PovrayPeer& operator=(const PovrayPeer&) = delete;

  /// Writes the scene that `run` draws from then on; not timed.
  void set_scene(const Scene& scene);

  /// Throws std::runtime_error with POV-Ray's output if it fails.
  PovrayRun run() const;

  /// As "3.7.0.10".
  static std::string version();

 private:
  std::size_t thread_count_;
  std::filesystem::path directory_;  ///< its own, removed at the end
  std::string options_;
};

}  // namespace raytracer::bench

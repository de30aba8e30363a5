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

/// Bytes are its 8 bits; floats are from 16, of which rounding leaves an rmse below 1e-5.
template <typename Channel>
struct BasicPovrayRun {
  PovrayTimes times;
  Raster<Channel> image;
};
using PovrayRun = BasicPovrayRun<unsigned char>;
using PovrayFloatRun = BasicPovrayRun<float>;

/// Its +AM, +A and +R; jitter is off.
struct PovrayAntialiasing {
  int method = 1;        ///< 1: all of a pixel's depth^2 samples or none; 2: recursive
  double threshold = 0;  ///< difference of neighbours that makes it sample further
  int depth = 1;
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

  /// Alike, with these samples in place of the scene's own.
  PovrayFloatRun run(const PovrayAntialiasing& antialiasing) const;

  /// As "3.7.0.10".
  static std::string version();

 private:
  template <typename Channel>
  BasicPovrayRun<Channel> run_with(const std::string& options) const;

  std::size_t thread_count_;
  std::filesystem::path directory_;  ///< its own, removed at the end
  int width_ = 0;
  int height_ = 0;
  int samples_ = 1;  ///< per pixel, as the scene has them
};

}  // namespace raytracer::bench

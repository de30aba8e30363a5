// Embree as a peer: the same scene through its sphere points and triangle meshes.
//
// What the comparison grants it: this machine's instruction set without dispatch, relaxed
// arithmetic, the best of four ways to hand rays over, an image that was touched before. Squares
// of spheres become spheres, because it has nothing like them; planes are intersected beside it.
// Limits: distant lights, shadows "black", the transfer "linear".
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <string>

#include "engine/engine.h"
#include "tests/measure/peers/embree_kernel.h"
#include "tests/measure/peers/embree_world.h"

namespace raytracer::bench {

inline constexpr std::array embree_modes{EmbreeMode::coherent_packets,
                                         EmbreeMode::incoherent_packets, EmbreeMode::narrow_packets,
                                         EmbreeMode::single_rays};

std::string name_of(EmbreeMode mode);

struct EmbreeTimes {
  double build_ms = 0;                                 ///< the commit alone, not its arrays
  std::array<double, embree_modes.size()> trace_ms{};  ///< by mode
};

struct EmbreeRun {
  EmbreeTimes times;
  ByteImage image;  ///< of the first mode
};

class EmbreePeer {
 public:
  /// Builds and traces on as many threads as `pool` has.
  explicit EmbreePeer(WorkerPool& pool);
  ~EmbreePeer();
  EmbreePeer(const EmbreePeer&) = delete;
  EmbreePeer& operator=(const EmbreePeer&) = delete;

  /// Throws std::runtime_error for a scene outside the limits above.
  EmbreeRun run(const Scene& scene);

  /// The two halves of that, for who traces one scene more than once. `build_ms` is the commit
  /// alone; throws as `run` does.
  std::unique_ptr<EmbreeWorld> build(const Scene& scene, double& build_ms);

  /// Milliseconds. Of a channel either 8 bits or a float remain; `image` has the frame's size.
  template <typename Channel>
  double trace(const EmbreeWorld& world, EmbreeMode mode, Raster<Channel>& image);

  std::string version() const;
  int packet_width() const { return packet_width_; }

 private:
  WorkerPool& pool_;
  RTCDevice device_;
  int packet_width_;
};

}  // namespace raytracer::bench

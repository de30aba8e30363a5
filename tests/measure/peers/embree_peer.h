// Embree as a peer: the same scene through its sphere points and triangle meshes.
//
// What the comparison grants it: this machine's instruction set without dispatch, relaxed
// arithmetic, the best of four ways to hand rays over, an image that was touched before. Squares
// of spheres become spheres, because it has nothing like them; planes are intersected beside it.
// Open cylinders and cones are its linear curves, which have no caps.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <string>

#include "tests/measure/peers/embree_kernel.h"
#include "tests/measure/peers/embree_world.h"
#include "tests/measure/peers/peer.h"

namespace raytracer::peers {

class EmbreePeer : public Peer {
 public:
  /// Builds and traces on as many threads as `pool` has.
  explicit EmbreePeer(WorkerPool& pool);

  std::string name() const override { return "Embree"; }
  std::string version() const override;
  bool is_program() const override { return false; }
  std::optional<std::string> refusal(const Scene& scene) const override;
  bool omits_ambient(const Scene&) const override { return false; }
  std::vector<std::string> differences(const Scene& scene) const override;
  void set_scene(const Scene& scene) override;
  Drawing draw() override;
  /// Regular grids of side x side samples in every pixel; of each sample a random place in each of
  /// so many strata of soft lights.
  std::vector<Ladder> ladders() override;

 private:
  struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };

  Drawing draw_grid(int side, int light_side);
  /// In the way that was the fastest on a small grid of this kind; on a small one in every way.
  Setting grid(int side, int light_side);

  /// `build_ms` is the commit alone, not its arrays.
  std::unique_ptr<EmbreeWorld> build(double& build_ms);
  /// Milliseconds. Of a channel either 8 bits or a float remain.
  template <typename Channel>
  double trace(const EmbreeWorld& world, EmbreeMode mode, Raster<Channel>& image);
  /// By the fastest of all modes.
  template <typename Channel>
  void trace_in_all_modes(const EmbreeWorld& world, Raster<Channel>& image, Drawing& drawing);

  WorkerPool& pool_;
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device_;
  int packet_width_;
  Scene scene_;
  std::unique_ptr<EmbreeWorld> world_;   ///< of the ladders
  Image image_;                          ///< theirs
  std::array<EmbreeMode, 2> fastest_{};  ///< grids that do not fill packets, and those that do
};

}  // namespace raytracer::peers

#include "tests/measure/peers/embree_peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/measure/stopwatch.h"

namespace raytracer::bench {
namespace {

constexpr int tile_side_px = 32;

}  // namespace

std::string name_of(EmbreeMode mode) {
  switch (mode) {
    case EmbreeMode::coherent_packets:
      return "coherent packets";
    case EmbreeMode::incoherent_packets:
      return "incoherent packets";
    case EmbreeMode::narrow_packets:
      return "narrow packets";
    case EmbreeMode::single_rays:
      return "single rays";
  }
  return {};
}

EmbreePeer::EmbreePeer(WorkerPool& pool)
    : pool_(pool),
      device_(rtcNewDevice(fmt::format("threads={}", pool.thread_count()).c_str())),
      packet_width_(device_ ? embree_packet_width(device_) : 0) {
  if (!device_) throw std::runtime_error("Embree did not start");
}

EmbreePeer::~EmbreePeer() { rtcReleaseDevice(device_); }

EmbreeRun EmbreePeer::run(const Scene& scene) {
  EmbreeRun run;
  const auto world = build(scene, run.times.build_ms);
  for (std::size_t i = 0; i < embree_modes.size(); ++i) {
    ByteImage image(scene.camera.width, scene.camera.height);
    run.times.trace_ms[i] = trace(*world, embree_modes[i], image);
    if (i == 0) run.image = std::move(image);
  }
  return run;
}

std::unique_ptr<EmbreeWorld> EmbreePeer::build(const Scene& scene, double& build_ms) {
  auto world = make_embree_world(device_, scene);
  const Stopwatch watch;
  rtcCommitScene(world->scene.get());
  build_ms = watch.elapsed_ms();
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree reports an error");
  return world;
}

template <typename Channel>
double EmbreePeer::trace(const EmbreeWorld& world, EmbreeMode mode, Raster<Channel>& image) {
  const EmbreeFrame& frame = world.frame;
  const int columns = (frame.width + tile_side_px - 1) / tile_side_px;
  const int rows = (frame.height + tile_side_px - 1) / tile_side_px;
  const std::atomic<bool> stop{false};
  const Stopwatch watch;
  pool_.run(
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
      [&](std::size_t tile) {
        const int x = static_cast<int>(tile) % columns * tile_side_px;
        const int y = static_cast<int>(tile) / columns * tile_side_px;
        trace_embree_tile(frame, mode, packet_width_, x, y, std::min(x + tile_side_px, frame.width),
                          std::min(y + tile_side_px, frame.height), image.values.data());
      },
      stop);
  return watch.elapsed_ms();
}

template double EmbreePeer::trace(const EmbreeWorld&, EmbreeMode, ByteImage&);
template double EmbreePeer::trace(const EmbreeWorld&, EmbreeMode, Image&);

std::string EmbreePeer::version() const {
  const auto property = [&](RTCDeviceProperty name) {
    return static_cast<int>(rtcGetDeviceProperty(device_, name));
  };
  return fmt::format("{}.{}.{}", property(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     property(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     property(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

}  // namespace raytracer::bench

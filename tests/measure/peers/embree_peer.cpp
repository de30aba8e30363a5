#include "tests/measure/peers/embree_peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "engine/measure/stopwatch.h"
#include "tests/measure/peers/scene_features.h"

namespace raytracer::peers {
namespace {

constexpr int tile_side_px = 32;
constexpr int largest_side = 32;
constexpr int side_in_all_modes = 6;  // beyond, only the fastest of smaller ones

constexpr std::array modes{EmbreeMode::coherent_packets, EmbreeMode::incoherent_packets,
                           EmbreeMode::narrow_packets, EmbreeMode::single_rays};

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

Image as_floats(const ByteImage& levels) {
  Image image(levels.width, levels.height);
  std::transform(levels.values.begin(), levels.values.end(), image.values.begin(),
                 [](unsigned char level) { return static_cast<float>(level) / 255; });
  return image;
}

}  // namespace

EmbreePeer::EmbreePeer(WorkerPool& pool)
    : pool_(pool),
      device_(rtcNewDevice(fmt::format("threads={}", pool.thread_count()).c_str())),
      packet_width_(device_ ? embree_packet_width(device_.get()) : 0) {
  if (!device_) throw std::runtime_error("Embree did not start");
}

std::string EmbreePeer::version() const {
  const auto property = [&](RTCDeviceProperty name) {
    return static_cast<int>(rtcGetDeviceProperty(device_.get(), name));
  };
  return fmt::format("{}.{}.{}, packets of {}", property(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     property(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     property(RTC_DEVICE_PROPERTY_VERSION_PATCH), packet_width_);
}

std::optional<std::string> EmbreePeer::refusal(const Scene& scene) const {
  const SceneFeatures features = features_of(scene);
  if (auto type = first_unknown(features.objects,
                                {"sphere", "spheres", "sphere_square", "plane", "mesh", "cylinder",
                                 "cylinders", "cone", "cones"},
                                "objects"))
    return type;
  if (auto type = first_unknown(
          features.lights,
          {"distant", "distant with an angle", "point", "point with a radius", "sky"}, "lights"))
    return type;
  return first_reason({{features.has_transparent_background, "a transparent background"},
                       {features.has_item_colors, "sets with a colour for each item"},
                       {features.has_vertex_colors, "meshes with a colour for each vertex"},
                       {features.has_smooth_meshes, "smooth meshes"},
                       {features.has_caps, "cylinders and cones that are closed"},
                       {features.has_glass, "glass"}});
}

std::vector<std::string> EmbreePeer::differences(const Scene& scene) const {
  if (std::none_of(scene.lights.begin(), scene.lights.end(), is_soft)) return {};
  return {"other places of soft lights"};
}

void EmbreePeer::set_scene(const Scene& scene) {
  world_.reset();
  scene_ = scene;
}

Drawing EmbreePeer::draw() {
  Drawing drawing;
  const auto world = build(drawing.times.build_ms);
  if (scene_.render.transfer == Transfer::linear) {
    ByteImage image(scene_.camera.width, scene_.camera.height);
    trace_in_all_modes(*world, image, drawing);
    drawing.image = as_floats(image);
  } else {  // 8 bits would be too few before the transfer
    drawing.image = Image(scene_.camera.width, scene_.camera.height);
    trace_in_all_modes(*world, drawing.image, drawing);
  }
  return drawing;
}

std::vector<Ladder> EmbreePeer::ladders() {
  constexpr double always = std::numeric_limits<double>::infinity();  // a finer grid may be worse
  constexpr int fine = 8;  // where each grid is slow: larger ones grow by a part of themselves,
                           // but for the best ones, which fill packets
  double build_ms = 0;
  world_ = build(build_ms);
  image_ = Image(scene_.camera.width, scene_.camera.height);
  std::vector<int> light_sides{0};
  if (std::any_of(scene_.lights.begin(), scene_.lights.end(), is_soft)) light_sides = {1, 2, 4, 8};
  std::vector<Ladder> ladders;
  for (const int light_side : light_sides) {
    Ladder all{{}, always};
    Ladder filling_packets{{}, always};
    for (int side = 1; side <= largest_side; side += light_side > 0 ? 1 + side / fine : 1)
      all.settings.push_back(grid(side, light_side));
    for (int side = 1; side <= largest_side; ++side)
      if (side * side % packet_width_ == 0)
        filling_packets.settings.push_back(grid(side, light_side));
    ladders.push_back(std::move(all));
    ladders.push_back(std::move(filling_packets));
  }
  return ladders;
}

Setting EmbreePeer::grid(int side, int light_side) {
  std::string name = fmt::format("{0} x {0}", side);
  if (light_side > 0) name += fmt::format(", {0} x {0} on each light", light_side);
  return {name, [this, side, light_side] { return draw_grid(side, light_side); }};
}

Drawing EmbreePeer::draw_grid(int side, int light_side) {
  set_sample_grid(*world_, side);
  set_random_places(*world_, light_side);
  EmbreeMode& fastest = fastest_[side * side % packet_width_ == 0 ? 1 : 0];
  Drawing drawing;
  drawing.times.trace_ms = std::numeric_limits<double>::infinity();
  for (const EmbreeMode mode : modes) {
    if (side > side_in_all_modes && mode != fastest) continue;
    const double ms = trace(*world_, mode, image_);
    if (ms >= drawing.times.trace_ms) continue;
    drawing.times.trace_ms = ms;
    drawing.way = name_of(mode);
    fastest = mode;
  }
  drawing.image = image_;
  return drawing;
}

std::unique_ptr<EmbreeWorld> EmbreePeer::build(double& build_ms) {
  auto world = make_embree_world(device_.get(), scene_);
  const Stopwatch watch;
  rtcCommitScene(world->scene.get());
  build_ms = watch.elapsed_ms();
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
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

template <typename Channel>
void EmbreePeer::trace_in_all_modes(const EmbreeWorld& world, Raster<Channel>& image,
                                    Drawing& drawing) {
  drawing.times.trace_ms = std::numeric_limits<double>::infinity();
  for (const EmbreeMode mode : modes) {
    const double ms = trace(world, mode, image);
    if (ms >= drawing.times.trace_ms) continue;
    drawing.times.trace_ms = ms;
    drawing.way = name_of(mode);
  }
}

}  // namespace raytracer::peers

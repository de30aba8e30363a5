#include "engine/plan/tiles.h"

#include <fmt/format.h>

#include <cstdint>

#include "engine/plan/counted.h"

namespace raytracer {
namespace {

constexpr double tiles_per_thread = 16;
constexpr double most_rays = 3 << 14;
constexpr int largest = 64;
constexpr int smallest = 16;  // a block of the kernel and a bin of the screen

}  // namespace

int interruptible_side_px(int samples, std::size_t light_count) {
  const double rays_per_pixel = samples * (1 + static_cast<double>(light_count));
  int side = largest;
  while (side > smallest && side * side * rays_per_pixel > most_rays) side /= 2;
  return side;
}

int tile_side_px(int width, int height, int samples, std::size_t light_count,
                 std::size_t thread_count) {
  const double pixels = static_cast<double>(width) * height;
  int side = interruptible_side_px(samples, light_count);
  while (side > smallest &&
         pixels / (side * side) < tiles_per_thread * static_cast<double>(thread_count))
    side /= 2;
  return side;
}

Choice<int> choose_tile_side(const Scene& scene, std::size_t thread_count) {
  const Camera& camera = scene.camera;
  const int side = tile_side_px(camera.width, camera.height, scene.render.samples.value_or(1),
                                scene.lights.size(), thread_count);
  const auto along = [&](int length_px) {
    return static_cast<std::uint64_t>((length_px + side - 1) / side);
  };
  return {side, fmt::format("{} for {}: large, because each costs a lock, but where the image "
                            "allows {:.0f} or more for each thread, to share the work evenly, and "
                            "of at most {} rays, so that other renders have their turn",
                            counted(along(camera.width) * along(camera.height), "tile"),
                            counted(thread_count, "thread"), tiles_per_thread,
                            grouped(static_cast<std::uint64_t>(most_rays)))};
}

}  // namespace raytracer

#include "engine/plan/tiles.h"

#include <fmt/format.h>

#include <cstdint>

#include "engine/plan/counted.h"

namespace raytracer {
namespace {

constexpr double tiles_per_thread = 16;
constexpr double most_samples = 1 << 14;

}  // namespace

int tile_side_px(int width, int height, int samples, std::size_t thread_count) {
  constexpr int largest = 64;
  constexpr int smallest = 16;
  const double pixels = static_cast<double>(width) * height;
  int side = largest;
  while (side > smallest &&
         (pixels / (side * side) < tiles_per_thread * static_cast<double>(thread_count) ||
          static_cast<double>(side) * side * samples > most_samples))
    side /= 2;
  return side;
}

Choice<int> choose_tile_side(const Camera& camera, const RenderSettings& settings,
                             std::size_t thread_count) {
  const int side =
      tile_side_px(camera.width, camera.height, settings.samples.value_or(1), thread_count);
  const auto along = [&](int length_px) {
    return static_cast<std::uint64_t>((length_px + side - 1) / side);
  };
  return {side, fmt::format("{} for {}: large, because each costs a lock, but where the image "
                            "allows {:.0f} or more for each thread, to share the work evenly, and "
                            "of at most {} samples, so that other renders have their turn",
                            counted(along(camera.width) * along(camera.height), "tile"),
                            counted(thread_count, "thread"), tiles_per_thread,
                            grouped(static_cast<std::uint64_t>(most_samples)))};
}

}  // namespace raytracer

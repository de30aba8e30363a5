#include "engine/plan/tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "engine/math/block.h"
#include "engine/plan/light_sampling.h"
#include "engine/scene/work.h"
#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

// Chosen: the last tile leaves the other threads idle for a sixteenth of the time at most.
constexpr double tiles_per_thread = 16;
// Chosen: some 0.5 to 2 ms of one thread, by 9 ns a ray on the shipped scene `demo`, 30 on
// `square-500`.
constexpr double most_rays = 3 << 14;
// Chosen: a third of that.
constexpr double few_rays = 1 << 14;
// In pixels. Chosen: a lock is nothing beside 4,096 rays.
constexpr int largest = 64;

double rays_per_pixel(int samples, std::size_t light_rays) {
  return samples * (1 + static_cast<double>(light_rays));
}

int tile_side_px(const Scene& scene, int samples, std::size_t thread_count) {
  const double pixels = scene.camera.pixel_count();
  int side = interruptible_side_px(samples, light_rays_per_sample(scene));
  while (side > block_side &&
         pixels / (side * side) < tiles_per_thread * static_cast<double>(thread_count))
    side /= 2;
  return side;
}

}  // namespace

int interruptible_side_px(int samples, std::size_t light_rays) {
  const double rays = rays_per_pixel(samples, light_rays);
  int side = largest;
  while (side > block_side && side * side * rays > most_rays) side /= 2;
  return side;
}

bool is_one_tile(const Scene& scene, int samples) {
  return count_rays(scene, 1) * rays_per_pixel(samples, light_rays_per_sample(scene)) <= few_rays;
}

Choice<int> choose_tile_side(const Scene& scene, int samples, std::size_t thread_count) {
  const Camera& camera = scene.camera;
  if (is_one_tile(scene, samples))
    return {std::max(camera.width, camera.height),
            because("the whole image: so few rays are traced before another thread has woken up")};
  const int side = tile_side_px(scene, samples, thread_count);
  const auto along = [side](int length_px) {
    return static_cast<std::uint64_t>((length_px + side - 1) / side);
  };
  const std::uint64_t tiles = along(camera.width) * along(camera.height);
  return {side, [tiles, thread_count] {
            return fmt::format(
                "{} for {}: few, because each costs a lock, but where the image allows {:.0f} or "
                "more for each thread, to share the work evenly, and of at most {} rays each, so "
                "that other renders have their turn",
                pluralised(tiles, "tile"), pluralised(thread_count, "thread"), tiles_per_thread,
                grouped(static_cast<std::uint64_t>(most_rays)));
          }};
}

}  // namespace raytracer

// Where a batch of rays has its values, for the kernels that trace it and for those in double that
// turn its rays.
#pragma once

#include <cstddef>

namespace raytracer {

/// A batch has room for so many: as many as are traced together where rays do not branch. Where
/// they do, the shipped glass takes 1.2 times as long with 64, 1.05 with 256.
inline constexpr std::size_t most_rays = 2048;

/// From one column to the next: an odd number of cache lines, or they would displace each other.
template <typename T>
inline constexpr std::size_t ray_stride = most_rays + 64 / sizeof(T);

/// Numbers of columns, as many values to each as the batch has room for. Of vectors the first of
/// three.
struct RayColumn {
  static constexpr std::size_t direction = 0;
  static constexpr std::size_t point = 3;
  static constexpr std::size_t normal = 6;
  static constexpr std::size_t id = 9;
  static constexpr std::size_t u = 10;
  static constexpr std::size_t v = 11;
  static constexpr std::size_t weight = 12;
  static constexpr std::size_t pixel = 13;
  static constexpr std::size_t followers = 14;
  static constexpr std::size_t solids = 15;  ///< only where rays branch

  // Only of paths that are carried in double.
  static constexpr std::size_t direction_rest = 16;  ///< what single rounds off
  static constexpr std::size_t point_rest = 19;
  static constexpr std::size_t turn = 22;         ///< a Turn
  static constexpr std::size_t t = 23;            ///< from `point` to where it turns, about
  static constexpr std::size_t left_id = 24;      ///< of the surface that was left in `point`
  static constexpr std::size_t left_normal = 25;  ///< its normal there

  static constexpr std::size_t count = 28;
};

/// How a ray goes on from where it has met a surface.
enum class Turn { mirrored, refracted, straight };

/// Rays of a batch that have yet to turn: `point` and `direction` are those of the way to the
/// surface, the rest is of where they leave it.
struct TurningRays {
  float* columns;  ///< at the beginning of a cache line, each of them
  std::size_t count;
};

}  // namespace raytracer

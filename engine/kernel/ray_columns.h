// Where a batch of rays has its values, for the kernels that trace it and for those in double that
// turn its rays.
#pragma once

#include <cstddef>

namespace raytracer {

/// A batch has room for so many: as many as are traced together where rays do not branch. Where
/// they do, smaller ones are filled worse: with 256 the shipped glass took 1.05 times as long as
/// with 1,024.
inline constexpr std::size_t rays_in_batch = 2048;

/// From one column to the next. A packet that is not full may be stored behind the last ray; and an
/// odd number of cache lines keeps columns from displacing each other.
template <typename T>
inline constexpr std::size_t ray_stride = rays_in_batch + 64 / sizeof(T);

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
  static constexpr std::size_t rests = 16;  ///< so far behind a vector is what single rounds off it
  static constexpr std::size_t direction_rest = direction + rests;
  static constexpr std::size_t point_rest = point + rests;
  static constexpr std::size_t turn = 22;         ///< a Turn, only where rays branch
  static constexpr std::size_t side = 23;         ///< on which it turns, likewise: inside 1
  static constexpr std::size_t t = 24;            ///< from `point` to where it turns, about
  static constexpr std::size_t left_id = 25;      ///< of the surface that was left in `point`
  static constexpr std::size_t left_normal = 26;  ///< its normal there

  static constexpr std::size_t count = 29;
};

/// How a ray goes on from where it has met a surface.
enum class Turn { mirrored, refracted, straight };

/// Rays of a batch that have yet to turn: `point` and `direction`, their rests, `t` and what was
/// left are of the way to the surface; `normal`, `id`, `u`, `v` and `side` of the surface itself.
struct TurningRays {
  float* columns;  ///< at the beginning of a cache line, each of them
  std::size_t count;
};

}  // namespace raytracer

// One step of a packet's paths, on its way from the kernels in single precision to those in double
// and back.
#pragma once

#include <array>
#include <cstddef>

namespace raytracer {

/// From one surface to the next, and on from there. A lane that does not go on has no `id` (-1).
struct PathStep {
  static constexpr std::size_t most_lanes = 16;
  struct alignas(64) Column : std::array<float, most_lanes> {};
  using Vectors = std::array<Column, 3>;
  /// Of which single holds a part, and what it rounds off: together some 48 binary digits.
  struct LongVectors {
    Vectors rounded;
    Vectors rest;
  };

  std::size_t lanes;
  bool bends;  ///< some lane is refracted

  LongVectors from;
  LongVectors direction;
  Vectors from_normal;  ///< of the surface that is left
  Column from_id;

  Column id;       ///< of what single has found that they meet
  Column t;        ///< about there
  Column u, v;     ///< as Hit has them; of what has an inside `u` is the side
  Vectors normal;  ///< of the side that is met; as single has found it

  // What follows.
  LongVectors at;
  LongVectors mirrored;
  LongVectors refracted;  ///< if `bends`
};

}  // namespace raytracer

// Places on soft lights, from which their light is sampled: the same for many points, so that what
// hides one of them is found as what hides a light that is no larger.
//
// They are in sets. Neighbouring pixels and samples use different ones, which turns the bands that
// few places make into grain; or a pixel's samples share them out, so that together they use all.
#pragma once

#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/lights/light_kind.h"

namespace raytracer {

/// How many places lights are sampled at.
struct LightSampling {
  int sets = 1;
  int per_set = 64;  ///< of a disc; of a sky axes, of which each point sees one end
  /// Whether a pixel's samples share out all sets, which are then parts of one lattice. Else each
  /// takes one, and neighbouring pixels' others.
  bool is_shared_out = false;
};

/// Some of the sets: one, and every step-th after it.
struct PlaceSets {
  static constexpr std::size_t only_one = std::numeric_limits<std::size_t>::max() / 2;

  std::size_t index = 0;
  std::size_t step = only_one;

  static PlaceSets all() { return {0, 1}; }
};

/// Of `sets` that are shared out among some samples, or groups of them, those of the nth: as many
/// as others have. The first `half_count` of the `count` are a pixel's half buffer A, the others B:
/// each half uses all, so that what all places leave out does not part the halves, as if more
/// samples would lower it.
inline PlaceSets share_of_sets(std::size_t nth, std::size_t half_count, std::size_t count,
                               std::size_t sets) {
  const bool is_in_a = nth < half_count;
  const std::size_t step = std::gcd(is_in_a ? half_count : count - half_count, sets);
  return {(is_in_a ? nth : nth - half_count) % step, step};
}

/// A soft light and the places on it, set after set: of a disc of directions unit vectors towards
/// them; of a sky one for each axis, which stands for its opposite too; of a disc around a place
/// their (x, y) in the unit disc.
struct SoftLight {
  PackedLight light;
  std::size_t per_set = 0;
  std::vector<Vec3> places;
};

SoftLight place_samples(const PackedLight& light, const LightSampling& sampling);

/// The set that a sample of a pixel uses, of 1, 2 or a multiple of 4: each of a square of 2 x 2
/// pixels another, as far as there are, and each of as many samples.
int light_set_of(int x, int y, int sample, int sets);

}  // namespace raytracer

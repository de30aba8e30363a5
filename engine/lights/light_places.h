// Places on soft lights, from which their light is sampled: the same for many points, so that what
// hides one of them is found as what hides a light that is no larger.
//
// They are in sets. Neighbouring pixels and samples use different ones, which turns the bands that
// few places make into grain, and tells a pixel's half buffers apart by what few places err: a
// contract refines where they do.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/lights/light_kind.h"

namespace raytracer {

/// How many places lights are sampled at.
struct LightSampling {
  int sets = 1;
  int per_set = 64;  ///< of a disc; of a sky axes, of which each point sees one end
  /// Whether all samples of a pixel look at the same set.
  bool is_alone = true;
  /// How many sets a point looks at before it counts as seeing nothing of a light that would bring
  /// the ambient part.
  int sets_to_be_sure = 1;
};

/// A soft light and the places on it, set after set: of a disc of directions unit vectors towards
/// them; of a sky one for each axis, which stands for its opposite too; of a disc around a place
/// their (x, y) in the unit disc.
struct SoftLight {
  PackedLight light;
  std::size_t per_set = 0;
  std::vector<Vec3> places;
};

SoftLight place_samples(const PackedLight& light, const LightSampling& sampling);

/// The set that a pixel's nth sample uses, of 1, 2 or a multiple of 4, where the first
/// `half_a_count` samples are one of two half buffers, or 0 where it has none: each sample another,
/// as far as there are. Half buffers never share one, so that they differ by what sets err however
/// many samples there are. Those of twice as many samples use others, as far as there are, so that
/// a refinement changes what both err.
int light_set_of_sample(std::size_t nth, std::size_t half_a_count, int sets);

/// The set that a pixel uses in place of that of its sample: each of a square of 2 x 2 pixels
/// another, as far as there are.
int light_set_of(int x, int y, int of_sample, int sets);

}  // namespace raytracer

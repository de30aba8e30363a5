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
  /// How many places on a disc's rim it looks at after its own set and before the others, a
  /// multiple of 8: what goes out of sight behind an edge goes out of sight there last, where
  /// places of equal areas are few. A segment between n places of the rim is as narrow as one over
  /// their square, one without any of n of equal areas only as one over their power of 2/3.
  int on_rim = 0;
};

/// Some of a soft light's places, one after another.
struct PlaceRange {
  std::size_t first;
  std::size_t count;
  std::size_t told;  ///< of the first, its place among those that a ledger tells of
};

/// The places of a soft light by their numbers: set after set, then those on its rim.
struct PlaceNumbers {
  std::size_t sets = 0;
  std::size_t per_set = 0;
  std::size_t on_rim = 0;

  std::size_t count() const { return sets * per_set + on_rim; }
  /// How many a ledger tells a point of: those of its own set and those on the rim.
  std::size_t told() const { return per_set + on_rim; }
  PlaceRange of_set(std::size_t set) const { return {set * per_set, per_set, 0}; }
  /// Those on the rim in runs, each of which goes around it: most points that see some of it are
  /// told by the first.
  static constexpr std::size_t rim_run = 8;
  std::size_t rim_runs() const { return on_rim / rim_run; }
  PlaceRange of_rim(std::size_t run) const {
    return {sets * per_set + run * rim_run, rim_run, per_set + run * rim_run};
  }
  bool is_on_rim(std::size_t place) const { return place >= sets * per_set; }
  std::size_t set_of(std::size_t place) const { return place / per_set; }
  std::size_t told_of(std::size_t place) const {
    return is_on_rim(place) ? per_set + place - sets * per_set : place % per_set;
  }
};

/// A soft light and the places on it: of a disc of directions unit vectors towards them; of a sky
/// one for each axis, which stands for its opposite too; of a disc around a place their (x, y) in
/// the unit disc.
struct SoftLight {
  PackedLight light;
  PlaceNumbers numbers;
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

// What the census keeps of spheres while it goes through them one after another.
//
// There may be hundreds of thousands, and a division or a root takes as long as all else that is
// done with one: most need one of each.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/vec.h"

namespace raytracer {

inline constexpr double step_of_doubles = 0x1p-53;  ///< of their size, at most

/// Lengths in frame coordinates, distances from the eye, as in the census.
struct SphereTally {
  double lost = 0;
  double smallest = std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();    ///< surface; negative from inside
  double clearance = std::numeric_limits<double>::infinity();  ///< as the census's
  double farthest = 0;
  double least_sine = std::numeric_limits<double>::infinity();  ///< of half the angle it is seen at
  double distance_in_radii = 0;
  double place_in_radii = 0;  ///< the largest coordinate of a centre in the scene
  double small = 0;
  double blocks = 0;

  void note_distance(double distance, double radius, double sine) {
    smallest = std::min(smallest, radius);
    nearest = std::min(nearest, distance - radius);
    clearance = std::min(clearance, std::abs(distance - radius));
    farthest = std::max(farthest, distance + radius);
    if (sine > least_sine) return;
    least_sine = sine;
    distance_in_radii = std::max(distance_in_radii, (distance + radius) / radius);
  }

  void note_place(const Vec3& center, double radius) {
    const double place = max_abs(center);
    if (place > place_in_radii * radius) place_in_radii = place / radius;
  }
};

/// The tangent of half the angle at which a sphere is seen whose centre is at `distance`; up to a
/// ten thousandth too large. `sine` is radius / distance.
inline double tangent_seen(double distance, double radius, double sine) {
  const double sine2 = sine * sine;
  // The series of sine / sqrt(1 - sine2), its third term enlarged by more than the rest is.
  constexpr double small = 0.05;
  if (sine2 < small) return sine * (1 + sine2 * (0.5 + sine2 * 0.4));
  const double tangent2 = (distance - radius) * (distance + radius);
  return tangent2 > 0 ? radius / std::sqrt(tangent2) : 1e300;
}

}  // namespace raytracer

// The picture that a scene document means, in numbers of 113 bits and by brute force.
//
// Written from the definition of the scene document alone: of the engine it takes the structure
// that reading a document gives, and no arithmetic. What decides is compared with a tolerance of
// 1e-24, far above this arithmetic's rounding and far below what doubles can say.
//
// Limits: one sample a pixel, the transfer "linear". A square of more than 8 x 8 spheres is walked
// cell by cell: a ray can meet a sphere only above or below the sphere's own cell.
#pragma once

#include <vector>

#include "engine/engine.h"
#include "tests/extremes/quad.h"

namespace raytracer::extremes {

class Oracle {
 public:
  /// `scene` has to live as long.
  explicit Oracle(const Scene& scene);

  /// The colour, clamped, through the image point (x, y), in pixels, y upwards from the lower edge,
  /// moved by (dx, dy).
  Vec3 color(double x, double y, double dx = 0, double dy = 0) const;

 private:
  enum class Kind { none, sphere_outside, sphere_inside, flat };

  /// Where a ray leaves from, or what it has met.
  struct Place {
    Kind kind = Kind::none;
    std::size_t object = 0;
    std::size_t part = 0;
    QuadVec point;    ///< relative to the eye
    QuadVec normal;   ///< unit, towards where the ray came from
    QuadVec shading;  ///< likewise, as it shades; zero: the same
    QuadVec tint;     ///< the colour that corners tell
    bool is_tinted = false;
    Quad radius = 0;
    Quad t = 0;
  };

  static const QuadVec& shading_normal(const Place& place) {
    return dot(place.shading, place.shading) > 0 ? place.shading : place.normal;
  }

  class Search;

  bool is_hidden(const Place& place, const QuadVec& towards, Quad distance) const;
  QuadVec shade(const Place& place, const QuadVec& view) const;
  QuadVec radiance(QuadVec direction) const;

  const Scene& scene_;
  QuadVec forward_;
  QuadVec right_;
  QuadVec up_;
};

}  // namespace raytracer::extremes

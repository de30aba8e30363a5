// The picture that a scene document means, in numbers of 113 bits and by brute force.
//
// Written from the definition of the scene document alone: of the engine it takes the structure
// that reading a document gives, and no arithmetic. What decides is compared with a tolerance of
// 1e-24, far above this arithmetic's rounding and far below what doubles can say.
//
// Soft light is the mean over a few hundred places of each light, far more than an image's: its
// pictures are near enough to tell errors of a hundredth.
//
// Limits: one sample a pixel, the transfer "linear". A square of more than 8 x 8 spheres is walked
// cell by cell: a ray can meet a sphere only above or below the sphere's own cell.
#pragma once

#include "engine/engine.h"
#include "tests/extremes/oracle_search.h"
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
  const Material& material_of(const OraclePlace& place) const {
    return scene_.materials[scene_.objects[place.object].material];
  }
  /// How much of the light in that direction reaches the place.
  Quad visible_share(const OraclePlace& place, const QuadVec& towards, Quad distance) const;
  /// The mean of that over a disc around `centre`, a path to where light comes from or a direction
  /// of unit length from infinitely far away.
  Quad visible_share_of_disc(const OraclePlace& place, const QuadVec& centre, bool is_near,
                             Quad radius) const;
  /// By the cosine, of an open sky.
  Quad visible_share_of_sky(const OraclePlace& place, Quad reach) const;
  QuadVec shade(const OraclePlace& place, const QuadVec& view) const;
  /// What is seen, times the weight.
  QuadVec radiance(const OraclePlace& from, const QuadVec& direction, Quad weight, int depth) const;

  const Scene& scene_;
  Quad least_weight_ = 0;  ///< of rays that count: where they branch others are left out
  QuadVec forward_;
  QuadVec right_;
  QuadVec up_;
};

}  // namespace raytracer::extremes

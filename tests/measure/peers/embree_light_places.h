// The places of soft lights that shadow rays go to: the same for all points, so that packets stay
// together, or at random in strata, other ones for each point.
//
// Only embree_kernel.cpp may include this; it says why.
#pragma once

#include <math.h>

#include "tests/measure/peers/embree_kernel.h"
#include "tests/measure/peers/embree_lanes.h"

namespace raytracer::peers {

template <int width>
class LightPlaces : Lanes<width> {
 public:
  using typename Lanes<width>::F;
  using typename Lanes<width>::Vector;

  /// The seed makes the random ones differ between tiles.
  LightPlaces(const EmbreePlaces& places, unsigned seed) : places_(places) {
    for (unsigned i = 0; i < width; ++i)
      state_[i] = ((seed * static_cast<unsigned>(width) + i + 1) * 0x9E3779B9U) | 1U;
  }

  int disc_count() const { return is_random() ? strata() : places_.disc_count; }
  int sky_count() const { return is_random() ? strata() : places_.sphere_count; }
  bool is_random() const { return places_.random_side > 0; }

  struct DiscPlace {
    F x, y;
  };
  /// In the unit disc.
  DiscPlace on_disc(int i) {
    if (!is_random()) return {splat(places_.disc_x[i]), splat(places_.disc_y[i])};
    const F radius = root((splat(static_cast<float>(i / places_.random_side)) + random()) *
                          (1.0F / static_cast<float>(places_.random_side)));
    const F angle = (splat(static_cast<float>(i % places_.random_side)) + random()) *
                    (6.2831853F / static_cast<float>(places_.random_side));
    F x;
    F y;
#pragma omp simd
    for (int lane = 0; lane < width; ++lane) {
      x[lane] = radius[lane] * cosf(angle[lane]);
      y[lane] = radius[lane] * sinf(angle[lane]);
    }
    return {x, y};
  }

  /// The same ones on the whole sphere; random ones above the surface, by the cosine.
  Vector in_sky(int i, const Vector& normal) {
    if (!is_random())
      return {splat(places_.sphere_x[i]), splat(places_.sphere_y[i]), splat(places_.sphere_z[i])};
    const DiscPlace place = on_disc(i);
    const F square = 1.0F - place.x * place.x - place.y * place.y;
    const Basis basis(normal);
    return plus(basis.across(place), times(normal, root(square > 0.0F ? square : F{})));
  }

  /// What a direction of the sky counts, of what all of an open one would be.
  F sky_weight(F cosine) const {
    if (is_random()) return splat(1.0F / static_cast<float>(strata()));
    return cosine * (4.0F / static_cast<float>(places_.sphere_count));
  }

  /// Two unit vectors across another (Duff and others: "Building an Orthonormal Basis, Revisited").
  class Basis {
   public:
    explicit Basis(const Vector& v) {
      const F sign = v.z >= 0.0F ? splat(1) : splat(-1);
      const F a = -1.0F / (sign + v.z);
      const F b = v.x * v.y * a;
      first_ = {1.0F + sign * v.x * v.x * a, sign * b, -sign * v.x};
      second_ = {b, sign + v.y * v.y * a, -v.y};
    }
    Vector across(const DiscPlace& place) const {
      return plus(times(first_, place.x), times(second_, place.y));
    }

   private:
    Vector first_;
    Vector second_;
  };

 private:
  using Lanes<width>::plus;
  using Lanes<width>::root;
  using Lanes<width>::splat;
  using Lanes<width>::times;

  int strata() const { return places_.random_side * places_.random_side; }

  /// From 0 to 1 (Marsaglia's xorshift).
  F random() {
    F result;
    for (int i = 0; i < width; ++i) {
      unsigned x = state_[i];
      x ^= x << 13;
      x ^= x >> 17;
      x ^= x << 5;
      state_[i] = x;
      result[i] = static_cast<float>(x >> 8) * 0x1p-24F;
    }
    return result;
  }

  const EmbreePlaces& places_;
  unsigned state_[width];
};

}  // namespace raytracer::peers

// How much of each light points see.
//
// Only embree_kernel.cpp may include this; it says why.
#pragma once

#include "tests/measure/peers/embree_light_places.h"
#include "tests/measure/peers/embree_rays.h"

namespace raytracer::peers {

/// Every function takes a mask of the points that matter, and how often the rays that met them were
/// reflected before.
template <int width>
class Shadows : Lanes<width> {
 public:
  using typename Lanes<width>::F;
  using typename Lanes<width>::M;
  using typename Lanes<width>::Vector;

  Shadows(const EmbreeFrame& frame, RayCaster<width>& rays, unsigned seed)
      : frame_(frame), rays_(rays), places_(frame.places, seed) {}

  /// What comes from a light's centre.
  struct Arriving {
    Vector path;     ///< to a point light
    Vector towards;  ///< unit
    F reach;
    F weakened;
  };
  Arriving arriving_from(const EmbreeLight& light, const Vector& point) const {
    Arriving result{{}, splat(light.place), splat(far_away), splat(1)};
    if (light.kind != EmbreeLightKind::point) return result;
    result.path = plus(result.towards, times(point, splat(-1)));
    const F square = dot(result.path, result.path);
    result.reach = root(square);
    result.towards = times(result.path, 1.0F / result.reach);
    if (light.fades) result.weakened = 1.0F / square;
    return result;
  }

  /// Of `visible` rays, how much of the light they see.
  F share_of(const EmbreeLight& light, const Arriving& arriving, const Vector& point,
             const Vector& normal, M visible, int depth) {
    if (!frame_.has_shadows) return visible ? splat(1) : F{};
    if (light.size == 0) {
      visible &= ~rays_.occluded(point, arriving.towards, arriving.reach, visible, depth);
      return visible ? splat(1) : F{};
    }
    const typename LightPlaces<width>::Basis basis(arriving.towards);
    F seen{};
    for (int i = 0; i < places_.disc_count(); ++i) {
      const Vector offset = times(basis.across(places_.on_disc(i)), splat(light.size));
      const bool is_near = light.kind == EmbreeLightKind::point;
      const Vector path = plus(is_near ? arriving.path : arriving.towards, offset);
      const Vector towards = unit(path);
      const M above = visible & (dot(normal, towards) > 0.0F);
      if (!any(above)) continue;
      const F reach = is_near ? root(dot(path, path)) : splat(far_away);
      const M open = above & ~rays_.occluded(point, towards, reach, above, depth);
      seen += open ? splat(1) : F{};
    }
    return seen * (1.0F / static_cast<float>(places_.disc_count()));
  }

  /// By the cosine, of an open sky.
  F share_of_sky(const Vector& point, const Vector& normal, M active, int depth) {
    F seen{};
    for (int i = 0; i < places_.sky_count(); ++i) {
      const Vector towards = places_.in_sky(i, normal);
      const F cosine = dot(normal, towards);
      const M above = active & (cosine > 0.0F);
      if (!any(above)) continue;
      M open = above;
      if (frame_.has_shadows)
        open &= ~rays_.occluded(point, towards, splat(far_away), above, depth);
      seen += open ? places_.sky_weight(cosine) : F{};
    }
    return seen;
  }

 private:
  using Lanes<width>::any;
  using Lanes<width>::dot;
  using Lanes<width>::plus;
  using Lanes<width>::root;
  using Lanes<width>::splat;
  using Lanes<width>::times;
  using Lanes<width>::unit;

  const EmbreeFrame& frame_;
  RayCaster<width>& rays_;
  LightPlaces<width> places_;
};

}  // namespace raytracer::peers

// The edges that cross pixels: silhouettes of spheres, and those of light on them.

#if defined(RAYTRACER_KERNEL_SIMD_PIXEL_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_PIXEL_EDGES_INL_H_
#undef RAYTRACER_KERNEL_SIMD_PIXEL_EDGES_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_PIXEL_EDGES_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/kernel/simd/light_edges-inl.h"
#include "engine/kernel/simd/lines-inl.h"
#include "engine/kernel/simd/part_spheres-inl.h"
#include "engine/kernel/simd/shown_sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// When a pixel that no edge crosses is even: a point in its middle errs by a 24th of the colour's
/// second derivative, which for an incidence is the turn of the normal squared, and for its power n
/// as much as n times that. Of 5,997 contracts on random scenes as many are kept as without.
template <typename T>
struct Evenness {
  T most_turn2;               ///< of the normal across a pixel, squared
  T most_turn2_of_highlight;  ///< likewise where one may be seen: not where ...
  T highlight_cosine;         ///< ... that of the normal with the half vector is less

  Evenness(const SimdScene<T>& scene, double negligible_error) {
    double brightness = 0;
    for (const SimdLight<T>& light : scene.lights)
      brightness +=
          static_cast<double>(std::max({light.emission.x, light.emission.y, light.emission.z}));
    brightness = std::max(brightness, 1.0);
    // More than that, and edges might bend within a pixel, or be those of colours that are clamped.
    const double most = std::min(0.05, 32 * negligible_error) / (brightness * brightness);
    most_turn2 = static_cast<T>(most);
    most_turn2_of_highlight = most_turn2;
    highlight_cosine = T(1);
    const double shininess = scene.has_specular ? scene.uniform_shininess : 0;
    if (!(shininess > 0) || !(negligible_error > 0)) return;
    most_turn2_of_highlight = static_cast<T>(std::min(most, 100 * negligible_error / shininess));
    // cos^n a <= exp(n (cos a - 1)).
    highlight_cosine = static_cast<T>(1 - std::log(brightness / negligible_error) / shininess);
  }
};

/// What crosses pixels, and how what they show turns.
template <class D>
class PixelEdges {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// Of the pixels with these middles, which show no other spheres than these and their shadows.
  HWY_INLINE PixelEdges(D d, const LineRays<D>& rays, const PartSpheres<T>& spheres,
                        const PartShadows<T>& shadows, const Evenness<T>& evenness,
                        const V3<V>& middles)
      : upright_(hn::Zero(d)),
        level_(upright_),
        turn2_(upright_),
        is_uneven_(hn::Lt(upright_, upright_)) {
    const V front = weigh_silhouettes(d, rays, spheres, middles);
    const M shows = hn::Ge(front, hn::Zero(d));
    if (!hn::AllFalse(d, shows))
      weigh_light(d, rays, spheres, shadows, evenness, middles, front, shows);
  }

  /// Pixels that more of is upright than level crosses.
  HWY_INLINE M are_level() const { return hn::Gt(level_, upright_); }
  /// Those that an edge may cross.
  HWY_INLINE M are_there() const { return hn::Gt(hn::Add(upright_, level_), hn::Zero(D())); }
  /// Those without any nearby, and all of which looks much the same.
  HWY_INLINE M are_even() const { return hn::Not(is_uneven_); }
  /// How far the normal turns across a pixel, in radians, squared.
  V turn2() const { return turn2_; }

 private:
  /// Adds an edge, where there is one, to how much of what crosses pixels is upright and how much
  /// level: by the squares of its normal, (across, along) of any length.
  HWY_INLINE void weigh(D d, M is_edge, V across, V along) {
    const V across2 = hn::Mul(across, across);
    const V along2 = hn::Mul(along, along);
    const V weight =
        hn::IfThenElseZero(is_edge, hn::Div(hn::Set(d, T(1)), hn::Add(across2, along2)));
    upright_ = hn::MulAdd(across2, weight, upright_);
    level_ = hn::MulAdd(along2, weight, level_);
  }

  /// Silhouettes. Returns the spheres that middles show; -1 for none.
  HWY_INLINE V weigh_silhouettes(D d, const LineRays<D>& rays, const PartSpheres<T>& spheres,
                                 const V3<V>& middles) {
    using S = PartSpheres<T>;
    const Triple<T> right = rays.steps[0];
    const Triple<T> up = rays.steps[1];
    const T pixel = std::sqrt(right.x * right.x + right.y * right.y + right.z * right.z);
    const V zero = hn::Zero(d);
    const V nearer = inverse_root(d, dot(middles, middles));
    const V3<V> direction = scale(middles, nearer);
    // Half a pixel's diagonal at a distance of 1.
    const V reach = hn::Mul(hn::Set(d, T(0.71) * pixel), nearer);
    V front = hn::Set(d, T(-1));
    M is_open = hn::Eq(zero, zero);
    for (std::size_t j = 0; j < spheres.count && !hn::AllFalse(d, is_open); ++j) {
      const auto all = [&](typename S::Value value)
                           HWY_ATTR { return hn::Set(d, spheres.values[value][j]); };
      const V3<V> c{all(S::x), all(S::y), all(S::z)};
      const V b = dot(c, direction);
      const V3<V> l = mul_add(direction, hn::Neg(b), c);
      const V beyond = hn::Sub(dot(l, l), all(S::radius2));
      front = hn::IfThenElse(hn::And(hn::Lt(front, zero), hn::Lt(beyond, zero)),
                             hn::Set(d, static_cast<T>(j)), front);
      const V near = hn::Mul(reach, b);
      const V radius = hn::Mul(all(S::radius2), all(S::curvature));
      const V width = hn::Mul(near, hn::MulAdd(hn::Set(d, T(2)), radius, near));
      const M is_edge = hn::And(hn::And(is_open, hn::Gt(b, zero)), hn::Lt(hn::Abs(beyond), width));
      weigh(d, is_edge, dot(l, broadcast(d, right)), dot(l, broadcast(d, up)));
      is_uneven_ = hn::Or(is_uneven_, is_edge);
      // What is behind a sphere that covers the pixel is not seen.
      is_open = hn::AndNot(hn::Lt(beyond, hn::Neg(width)), is_open);
    }
    return front;
  }

  /// Terminators and the rims of shadows on the spheres at `front`, where a middle shows one.
  HWY_INLINE void weigh_light(D d, const LineRays<D>& rays, const PartSpheres<T>& spheres,
                              const PartShadows<T>& shadows, const Evenness<T>& evenness,
                              const V3<V>& middles, V front, M shows) {
    const SimdScene<T>& scene = rays.scene();
    const V half = hn::Set(d, T(0.5));
    const ShownSpheres<D> sphere(d, spheres, hn::IfThenElseZero(shows, front));
    const auto sight = sphere.look(d, middles);
    const Start<V>& here = sight.at;
    const Start<V> right = sphere.look(d, mul_add(broadcast(d, rays.steps[0]), half, middles)).at;
    const Start<V> above = sphere.look(d, mul_add(broadcast(d, rays.steps[1]), half, middles)).at;
    const V3<V> turn_across = sub(right.normal, here.normal);
    const V3<V> turn_along = sub(above.normal, here.normal);
    turn2_ = hn::IfThenElseZero(
        shows, hn::Mul(hn::Set(d, T(4)),
                       hn::Add(dot(turn_across, turn_across), dot(turn_along, turn_along))));
    M is_even = hn::Le(turn2_, hn::Set(d, evenness.most_turn2));
    const M has_even_highlights = hn::Le(turn2_, hn::Set(d, evenness.most_turn2_of_highlight));
    const bool near_rim = scene.shadows != Shadows::off && is_near_rim(d, scene, here, shows);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
      const V3<V> towards = broadcast(d, scene.lights[i].place);
      const auto value_at = [&](const Start<V>& point) HWY_ATTR {
        return clearance(d, scene, shadows, i, point, dot(point.normal, towards), near_rim, shows);
      };
      const V f = value_at(here);
      const V across = hn::Sub(value_at(right), f);
      const V along = hn::Sub(value_at(above), f);
      const V change = hn::Add(hn::Abs(across), hn::Abs(along));
      weigh(d, hn::And(shows, hn::Lt(hn::Abs(f), change)), across, along);
      const M is_far = hn::Ge(hn::Abs(f), hn::Mul(hn::Set(d, nearby), change));
      is_even = hn::And(is_even, is_far);
      const V3<V> halfway = sub(towards, sight.direction);
      const V highlight =
          hn::Mul(hn::Set(d, evenness.highlight_cosine), hn::Sqrt(dot(halfway, halfway)));
      const M has_none = hn::Lt(dot(here.normal, halfway), highlight);
      is_even = hn::And(is_even, hn::Or(has_even_highlights, has_none));
    }
    is_uneven_ = hn::Or(is_uneven_, hn::AndNot(is_even, shows));
  }

  /// Edges seem to be farther by so much: what is not straight may come nearer.
  static constexpr T nearby = 2;

  V upright_;
  V level_;
  V turn2_;
  M is_uneven_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

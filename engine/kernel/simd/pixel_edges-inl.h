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

/// When a pixel that no edge crosses is even, so that a point in its middle tells its mean colour.
///
/// That errs by a 24th of the colour's second derivative, its bend: of an incidence the turn of the
/// normal across the pixel, squared, over the cosine at which it is seen, and of its power n at
/// most n times that. It may be half of the error that would not be missed.
template <typename T>
struct Evenness {
  T most_bend;
  T most_bend_of_highlight;  ///< where one may be seen: not where ...
  T highlight_cosine;        ///< ... that of the normal with the half vector is less
  T highlight_sine;
  T shininess;

  Evenness(const SimdScene<T>& scene, double negligible_error) {
    double brightness = 0;
    for (const SimdLight<T>& light : scene.lights)
      brightness +=
          static_cast<double>(std::max({light.emission.x, light.emission.y, light.emission.z}));
    brightness = std::max(brightness, 1.0);
    const double negligible_bend = 24 * negligible_error / 2;
    // Where colours that are clamped change by more across a pixel, they bend in it after all.
    const double most = std::min(0.05, negligible_bend) / (brightness * brightness);
    const double exponent =
        scene.has_specular ? std::max(1.0, static_cast<double>(scene.uniform_shininess)) : 1;
    most_bend = static_cast<T>(most);
    most_bend_of_highlight = static_cast<T>(std::min(most, negligible_bend / exponent));
    shininess = static_cast<T>(exponent);
    // cos^n a <= exp(n (cos a - 1)).
    const double cosine = 1 - std::log(brightness / negligible_error) / exponent;
    highlight_cosine = static_cast<T>(std::clamp(cosine, -1.0, 1.0));
    highlight_sine = static_cast<T>(std::sqrt(1 - highlight_cosine * highlight_cosine));
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
        bend_(upright_),
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
  /// Those that none does, and whose colour hardly bends.
  HWY_INLINE M are_even() const { return hn::Not(is_uneven_); }
  /// How much it bends across a pixel, as a share of it.
  V bend() const { return bend_; }

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
    const V3<V> across_half = sub(right.normal, here.normal);
    const V3<V> along_half = sub(above.normal, here.normal);
    const V across_half2 = dot(across_half, across_half);
    const V along_half2 = dot(along_half, along_half);
    const V facing = hn::Neg(dot(sight.direction, here.normal));
    const V bend = hn::Div(hn::Mul(hn::Set(d, T(4)), hn::Add(across_half2, along_half2)), facing);
    M is_even = hn::Le(bend, hn::Set(d, evenness.most_bend));
    const M has_even_highlights = hn::Le(bend, hn::Set(d, evenness.most_bend_of_highlight));
    // To the pixel's corners; towards the silhouette more than measured.
    const V turn =
        hn::Mul(hn::Set(d, T(1.25)), hn::Add(hn::Sqrt(across_half2), hn::Sqrt(along_half2)));
    // That of the angle that is greater by as much.
    const V highlight_cosine =
        hn::NegMulAdd(turn, hn::MulAdd(half, turn, hn::Set(d, evenness.highlight_sine)),
                      hn::Set(d, evenness.highlight_cosine));
    M may_have_highlight = hn::Lt(bend, bend);
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
      if (hn::AllFalse(d, hn::And(is_even, shows))) continue;
      is_even = is_evenly_lit(d, scene, shadows, i, here, dot(here.normal, towards),
                              hn::Mul(sphere.radius2, sphere.curvature), turn, near_rim, is_even);
      const V3<V> halfway = sub(towards, sight.direction);
      const V least = hn::Mul(highlight_cosine, hn::Sqrt(dot(halfway, halfway)));
      may_have_highlight = hn::Or(may_have_highlight, hn::Ge(dot(here.normal, halfway), least));
    }
    is_even = hn::And(is_even, hn::Or(has_even_highlights, hn::Not(may_have_highlight)));
    is_uneven_ = hn::Or(is_uneven_, hn::AndNot(is_even, shows));
    const V times =
        hn::IfThenElse(may_have_highlight, hn::Set(d, evenness.shininess), hn::Set(d, T(1)));
    bend_ = hn::IfThenElseZero(shows, hn::Mul(times, bend));
  }

  V upright_;
  V level_;
  V bend_;
  M is_uneven_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

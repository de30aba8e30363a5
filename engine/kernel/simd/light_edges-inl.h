// Where along a line across a sphere its light changes: the terminator and the rims of shadows.

#if defined(RAYTRACER_KERNEL_SIMD_LIGHT_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_LIGHT_EDGES_INL_H_
#undef RAYTRACER_KERNEL_SIMD_LIGHT_EDGES_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_LIGHT_EDGES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "engine/kernel/simd/part_spheres-inl.h"
#include "engine/kernel/simd/shade_plain-inl.h"
#include "engine/plan/integration.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// The spheres that may shadow something of a part, but for a square's neighbours, by lights.
template <typename T>
struct PartShadows {
  static constexpr std::size_t most = 32;
  struct OfLight {
    std::array<const LightDisc<T>*, most> discs;
    std::size_t count = 0;
  };
  std::array<OfLight, most_lights_of_lines> lights;
};

/// Those that stand before a light as seen from some of the part's spheres: around all of which
/// there is a rectangle across the light's direction.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE bool find_part_shadows(D d, const SimdScene<T>& scene, const PartSpheres<T>& spheres,
                                  PartShadows<T>& shadows) {
  using V = hn::Vec<D>;
  using S = PartSpheres<T>;
  if (scene.shadows == Shadows::off) return true;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const SimdLight<T>& light = scene.lights[i];
    auto& found = shadows.lights[i];
    found.count = 0;
    if (light.discs.empty()) continue;
    constexpr T highest = std::numeric_limits<T>::max();
    V u_low = hn::Set(d, highest);
    V v_low = u_low;
    V w_low = u_low;
    V u_high = hn::Neg(u_low);
    V v_high = u_high;
    for (std::size_t j = 0; j < spheres.count; j += hn::Lanes(d)) {
      const auto active = hn::FirstN(d, spheres.count - j);
      const auto all = [&](typename S::Value value)
                           HWY_ATTR { return hn::Load(d, spheres.values[value] + j); };
      const V3<V> c{all(S::x), all(S::y), all(S::z)};
      // A little more than rounding may move what is looked at.
      const V r = hn::Mul(hn::Mul(all(S::radius2), all(S::curvature)), hn::Set(d, T(1.01)));
      const V u = dot(c, broadcast(d, light.across[0]));
      const V v = dot(c, broadcast(d, light.across[1]));
      const V w = dot(c, broadcast(d, light.place));
      u_low = hn::IfThenElse(active, hn::Min(u_low, hn::Sub(u, r)), u_low);
      v_low = hn::IfThenElse(active, hn::Min(v_low, hn::Sub(v, r)), v_low);
      w_low = hn::IfThenElse(active, hn::Min(w_low, hn::Sub(w, r)), w_low);
      u_high = hn::IfThenElse(active, hn::Max(u_high, hn::Add(u, r)), u_high);
      v_high = hn::IfThenElse(active, hn::Max(v_high, hn::Add(v, r)), v_high);
    }
    const auto lowest_of = [&](V v) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(d, v)); };
    const auto highest_of = [&](V v) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(d, v)); };
    const T u_begin = lowest_of(u_low);
    const T u_end = highest_of(u_high);
    const T v_begin = lowest_of(v_low);
    const T v_end = highest_of(v_high);
    const T w_begin = lowest_of(w_low);
    for (const LightDisc<T>& disc : light.discs) {
      const T du = disc.u - std::clamp(disc.u, u_begin, u_end);
      const T dv = disc.v - std::clamp(disc.v, v_begin, v_end);
      if (du * du + dv * dv > disc.radius2 || disc.w < w_begin) continue;
      if (found.count == PartShadows<T>::most) return false;
      found.discs[found.count++] = &disc;
    }
  }
  return true;
}

/// By how much neighbours miss the ray from a sphere's point with `normal` to a distant light, in
/// the terms of stands_before(): negative if one stands before it, at most 1. Where a neighbour is
/// left behind it is missed by no less than nothing, as the point is outside of it: that goes on
/// continuously by the squared distance from it.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V clearance_of_neighbours(D d, const SimdSquare<T>& square, const Stencil<T>& stencil,
                                     const Start<V>& at, V incidence, bool near_rim) {
  const V one = hn::Set(d, T(1));
  const V3<V> normal = along_square(square, at.normal);
  const V half_incidence = hn::Mul(hn::Set(d, T(0.5)), incidence);
  const auto is_within = [&](V place, T low, T high) HWY_ATTR {
    return hn::And(hn::Ge(place, hn::Set(d, low)), hn::Le(place, hn::Set(d, high)));
  };
  V least = one;
  for (const StencilCell<T>& cell : stencil.cells) {
    const V first = hn::Set(d, cell.first);
    const V second = hn::Set(d, cell.second);
    const V b = hn::Max(hn::Sub(hn::Set(d, cell.forward), half_incidence), hn::Zero(d));
    const V beyond =
        hn::NegMulAdd(normal.x, first, hn::NegMulAdd(normal.z, second, hn::Set(d, cell.distance2)));
    V clear = hn::NegMulAdd(b, b, beyond);
    if (near_rim) {
      const auto is_there =
          hn::And(is_within(hn::Add(at.first, first), square.low_first, square.high_first),
                  is_within(hn::Add(at.second, second), square.low_second, square.high_second));
      clear = hn::IfThenElse(is_there, clear, one);
    }
    least = hn::Min(least, clear);
  }
  return least;
}

/// Positive where a plain light reaches the points, and continuous along a surface: the incidence,
/// or what the nearest occluder misses the light's ray by, whichever is less.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V clearance(D d, const SimdScene<T>& scene, const PartShadows<T>& shadows,
                       std::size_t light_index, const Start<V>& at, V incidence, bool near_rim,
                       M active) {
  if (scene.shadows == Shadows::off) return incidence;
  const SimdLight<T>& light = scene.lights[light_index];
  const auto& near = shadows.lights[light_index];
  const V one = hn::Set(d, T(1));
  V least = incidence;
  for (std::size_t i = 0; i < near.count; ++i) {
    const LightDisc<T>& disc = *near.discs[i];
    const V du = hn::Sub(dot(at.point, broadcast(d, light.across[0])), hn::Set(d, disc.u));
    const V dv = hn::Sub(dot(at.point, broadcast(d, light.across[1])), hn::Set(d, disc.v));
    const V beyond_it =
        hn::Max(hn::Sub(dot(at.point, broadcast(d, light.place)), hn::Set(d, disc.w)), hn::Zero(d));
    const V distance2 = hn::MulAdd(beyond_it, beyond_it, hn::MulAdd(du, du, hn::Mul(dv, dv)));
    const V clear =
        hn::Mul(hn::Sub(distance2, hn::Set(d, disc.radius2)), hn::Set(d, 1 / disc.radius2));
    const M is_other = hn::Ne(at.id, hn::Set(d, disc.id));
    least = hn::Min(least, hn::IfThenElse(is_other, clear, one));
  }
  const Stencil<T>* stencil = light.stencils.data();
  for (const SimdSquare<T>& square : scene.squares) {
    const M leaves = hn::And(active, hn::Eq(at.id, hn::Set(d, square.id)));
    if (!hn::AllFalse(d, leaves)) {
      const V clear = clearance_of_neighbours(d, square, *stencil, at, incidence, near_rim);
      least = hn::IfThenElse(leaves, hn::Min(least, clear), least);
    }
    ++stencil;
  }
  return least;
}

/// Three values of a function along a span: at its ends and in the middle.
template <class V>
struct SpanValues {
  V begin;
  V middle;
  V end;
};

/// Where the sign changes in one half of the span, the first if `is_first`, for lanes in which it
/// does; 0 to 1. By a parabola through the three, and from there by as many secants, the last of
/// which is not looked at; `value_at` gives the function's.
template <class D, class ValueAt, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE V sign_change(D d, const SpanValues<V>& values, M is_first, int secants,
                         const ValueAt& value_at) {
  const V zero = hn::Zero(d);
  const V half = hn::Set(d, T(0.5));
  const V two = hn::Set(d, T(2));
  V low = hn::IfThenElse(is_first, zero, half);
  V high = hn::Add(low, half);
  V f_low = hn::IfThenElse(is_first, values.begin, values.middle);
  V f_high = hn::IfThenElse(is_first, values.middle, values.end);
  const V square =
      hn::Mul(two, hn::NegMulAdd(two, values.middle, hn::Add(values.begin, values.end)));
  const V slope = hn::Sub(hn::Sub(values.end, values.begin), square);
  const V four = hn::Set(d, T(4));
  const V discriminant =
      hn::Max(hn::NegMulAdd(hn::Mul(four, square), values.begin, hn::Mul(slope, slope)), zero);
  const V q =
      hn::Mul(hn::Set(d, T(-0.5)), hn::Add(slope, hn::CopySign(hn::Sqrt(discriminant), slope)));
  const V root = hn::Div(values.begin, q);
  const M is_there = hn::And(hn::Ge(root, low), hn::Le(root, high));
  const V other = hn::Div(q, square);
  const M other_is_there = hn::And(hn::Ge(other, low), hn::Le(other, high));
  V x = hn::IfThenElse(is_there, root,
                       hn::IfThenElse(other_is_there, other, hn::Mul(half, hn::Add(low, high))));
  for (int i = 0; i < secants; ++i) {
    const V f = value_at(x);
    const M is_low = hn::Not(hn::Xor(hn::Gt(f, zero), hn::Gt(f_low, zero)));
    // The end that stays counts half, lest it stays for good (the Illinois method).
    const V stays = i > 0 ? half : hn::Set(d, T(1));
    low = hn::IfThenElse(is_low, x, low);
    f_low = hn::IfThenElse(is_low, f, hn::Mul(f_low, stays));
    high = hn::IfThenElse(is_low, high, x);
    f_high = hn::IfThenElse(is_low, hn::Mul(f_high, stays), f);
    x = hn::NegMulAdd(f_low, hn::Div(hn::Sub(high, low), hn::Sub(f_high, f_low)), low);
  }
  return x;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

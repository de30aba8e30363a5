// Spans of lines across a sphere, parted where a light's terminator or a shadow's rim crosses them,
// and the points at which to ask for the colours of what is between.

#if defined(RAYTRACER_KERNEL_SIMD_LIT_SPANS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_LIT_SPANS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_LIT_SPANS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_LIT_SPANS_INL_H_
#endif

#include <cstddef>

#include "engine/kernel/simd/light_edges-inl.h"
#include "engine/kernel/simd/lines-inl.h"
#include "engine/kernel/simd/shown_sphere-inl.h"
#include "engine/plan/integration.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Adds an edge, where there is one, to how much of what crosses pixels is upright and how much
/// level: by the squares of its normal, (across, along) of any length.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void weigh_edge(D d, M is_edge, V across, V along, V& upright, V& level) {
  const V across2 = hn::Mul(across, across);
  const V along2 = hn::Mul(along, along);
  const V weight = hn::IfThenElseZero(is_edge, hn::Div(hn::Set(d, T(1)), hn::Add(across2, along2)));
  upright = hn::MulAdd(across2, weight, upright);
  level = hn::MulAdd(along2, weight, level);
}

template <class D>
class LitSpans {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  explicit HWY_INLINE LitSpans(const LineRays<D>& rays) : rays_(rays), scene_(rays.scene()) {}

  /// These are the spheres that lines may show. False where too many others shadow them.
  HWY_INLINE bool set(D d, const PartSpheres<T>& spheres) {
    return find_part_shadows(d, scene_, spheres, shadows_);
  }

  /// Adds to how much of what crosses pixels, whose middles show these of the spheres, is upright
  /// and how much level: the edges of light.
  HWY_INLINE void weigh_edges(D d, const PartSpheres<T>& spheres, const V3<V>& through, V front,
                              M active, V& upright, V& level) const {
    if (hn::AllFalse(d, active)) return;
    const V half = hn::Set(d, T(0.5));
    const ShownSpheres<D> sphere(d, spheres, hn::IfThenElseZero(active, front));
    const Start<V> here = sphere.look(d, through).at;
    const Start<V> right = sphere.look(d, mul_add(broadcast(d, rays_.steps[0]), half, through)).at;
    const Start<V> above = sphere.look(d, mul_add(broadcast(d, rays_.steps[1]), half, through)).at;
    const bool near_rim = scene_.shadows != Shadows::off && is_near_rim(d, scene_, here, active);
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const V3<V> towards = broadcast(d, scene_.lights[i].place);
      const auto value_at = [&](const Start<V>& point) HWY_ATTR {
        return clearance(d, scene_, shadows_, i, point, dot(point.normal, towards), near_rim,
                         active);
      };
      const V f = value_at(here);
      const V across = hn::Sub(value_at(right), f);
      const V along = hn::Sub(value_at(above), f);
      const M crosses =
          hn::And(active, hn::Lt(hn::Abs(f), hn::Add(hn::Abs(across), hn::Abs(along))));
      weigh_edge(d, crosses, across, along, upright, level);
    }
  }

  /// Calls take(lanes, values of PointColumn ...) for the points of the packet of spans that begins
  /// at `first`.
  template <class Take>
  HWY_INLINE void part(D d, const Queue<D, SpanColumn::count>& spans, std::size_t first,
                       const PartSpheres<T>& spheres, const LineGrain<T>& grain,
                       const Take& take) const {
    using Span = SpanColumn;
    const V zero = hn::Zero(d);
    const V one = hn::Set(d, T(1));
    const V half = hn::Set(d, T(0.5));
    const M active = spans.active(d, first);
    const auto column = [&](typename Span::Name name)
                            HWY_ATTR { return spans.get(d, name, first); };
    const V begin = hn::IfThenElseZero(active, column(Span::begin));
    const V end = hn::IfThenElse(active, column(Span::end), one);
    const V length = hn::Sub(end, begin);
    const V right = column(Span::right);
    const V down = column(Span::down);
    const V is_upright = column(Span::is_upright);
    const V line = column(Span::line);
    const V sphere_index = hn::IfThenElseZero(active, column(Span::sphere));
    const ShownSpheres<D> sphere(d, spheres, sphere_index);
    const V3<V> from = rays_.begin(d, right, down);
    const V3<V> step = rays_.step(d, is_upright);
    const auto at = [&](V x) HWY_ATTR { return sphere.look(d, mul_add(step, x, from)).at; };
    const Start<V> at_begin = at(begin);
    const Start<V> at_middle = at(hn::Mul(half, hn::Add(begin, end)));
    const Start<V> at_end = at(end);
    const bool near_rim =
        scene_.shadows != Shadows::off && is_near_rim(d, scene_, at_middle, active);

    const std::size_t light_count = scene_.lights.size();
    V edges[2 * most_lights_of_lines];  // of each light in the first and in the second half
    M is_edge[2 * most_lights_of_lines];
    M begins_lit[most_lights_of_lines];
    bool has_edges = false;
    V bend = zero;
    for (std::size_t i = 0; i < light_count; ++i) {
      const V3<V> towards = broadcast(d, scene_.lights[i].place);
      const auto value_at = [&](const Start<V>& point, V incidence) HWY_ATTR {
        return clearance(d, scene_, shadows_, i, point, incidence, near_rim, active);
      };
      const SpanValues<V> incidences{dot(at_begin.normal, towards), dot(at_middle.normal, towards),
                                     dot(at_end.normal, towards)};
      bend = hn::Max(bend, hn::Abs(hn::NegMulAdd(hn::Set(d, T(2)), incidences.middle,
                                                 hn::Add(incidences.begin, incidences.end))));
      const SpanValues<V> values{value_at(at_begin, incidences.begin),
                                 value_at(at_middle, incidences.middle),
                                 value_at(at_end, incidences.end)};
      begins_lit[i] = hn::Gt(values.begin, zero);
      const M middle_lit = hn::Gt(values.middle, zero);
      const M in_first = hn::And(active, hn::Xor(begins_lit[i], middle_lit));
      const M in_second = hn::And(active, hn::Xor(middle_lit, hn::Gt(values.end, zero)));
      // One in either half first, then those in the second of lanes that have two.
      const auto find = [&](M which, M is_first, std::size_t place) HWY_ATTR {
        is_edge[place] = which;
        edges[place] = end;
        if (hn::AllFalse(d, which)) return;
        has_edges = true;
        const V x = sign_change(d, values, is_first, grain.secants, [&](V share) HWY_ATTR {
          const Start<V> point = at(hn::MulAdd(length, share, begin));
          return value_at(point, dot(point.normal, towards));
        });
        edges[place] = hn::IfThenElse(which, hn::MulAdd(length, x, begin), end);
      };
      find(hn::Or(in_first, in_second), in_first, 2 * i);
      find(hn::And(in_first, in_second), hn::Lt(zero, zero), 2 * i + 1);
    }

    const V3<V> turned = sub(at_end.normal, at_begin.normal);
    const V turn2 = dot(turned, turned);
    const V least = hn::Set(d, grain.least_pieces);
    const M is_bent = hn::Or(hn::Or(hn::Gt(bend, hn::Set(d, grain.negligible_bend)),
                                    hn::Gt(turn2, hn::Set(d, grain.negligible_turn2))),
                             hn::Gt(least, zero));
    const V pieces_per_length =
        hn::Div(hn::Sqrt(turn2), hn::Mul(length, hn::Set(d, grain.most_turn)));
    V x = begin;
    M rest = active;
    while (!hn::AllFalse(d, rest)) {
      V next = end;
      if (has_edges)
        for (std::size_t i = 0; i < 2 * light_count; ++i)
          next = hn::IfThenElse(hn::Gt(edges[i], x), hn::Min(next, edges[i]), next);
      const V width = hn::Sub(next, x);
      const V middle = hn::Mul(half, hn::Add(x, next));
      V lights = zero;
      for (std::size_t i = light_count; i-- > 0;) {
        M is_lit = begins_lit[i];
        if (has_edges)
          for (const std::size_t k : {2 * i, 2 * i + 1})
            is_lit = hn::Xor(is_lit, hn::And(is_edge[k], hn::Gt(middle, edges[k])));
        lights = hn::Add(hn::Add(lights, lights), hn::IfThenElseZero(is_lit, one));
      }
      const auto take_point = [&](M which, V place, V weight) HWY_ATTR {
        if (hn::AllFalse(d, which)) return;
        take(which, place, weight, right, down, is_upright, line, sphere_index, lights);
      };
      // By two points to a piece (Gauss), or by one where that is as good.
      const M has_pieces = hn::And(hn::And(rest, is_bent), hn::Gt(width, hn::Set(d, T(0.1))));
      take_point(hn::AndNot(has_pieces, rest), middle, width);
      const V pieces = hn::Max(one, hn::Ceil(hn::Mul(width, hn::Max(pieces_per_length, least))));
      const V half_piece = hn::Mul(half, hn::Div(width, pieces));
      const V away = hn::Mul(half_piece, hn::Set(d, T(0.57735026918962576)));
      V place = hn::Add(x, half_piece);
      M more = has_pieces;
      for (V i = one; !hn::AllFalse(d, more); i = hn::Add(i, one)) {
        take_point(more, hn::Sub(place, away), half_piece);
        take_point(more, hn::Add(place, away), half_piece);
        place = hn::Add(place, hn::Add(half_piece, half_piece));
        more = hn::And(more, hn::Lt(i, pieces));
      }
      x = next;
      rest = hn::And(rest, hn::Lt(x, end));
    }
  }

 private:
  const LineRays<D>& rays_;
  const SimdScene<T>& scene_;
  PartShadows<T> shadows_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

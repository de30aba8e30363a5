// Colours integrated along lines: smooth between the points at which what the lines show changes,
// so that a few points give the integral.

#if defined(RAYTRACER_KERNEL_SIMD_LINE_INTEGRAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_LINE_INTEGRAL_INL_H_
#undef RAYTRACER_KERNEL_SIMD_LINE_INTEGRAL_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_LINE_INTEGRAL_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/kernel/simd/lines-inl.h"
#include "engine/kernel/simd/lit_spans-inl.h"
#include "engine/kernel/simd/part_spheres-inl.h"
#include "engine/kernel/simd/shade-inl.h"
#include "engine/kernel/simd/shown_sphere-inl.h"
#include "engine/kernel/simd/silhouettes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Lines -> spans that show one sphere -> points -> colours.
template <class D>
class LineIntegral {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// Of lines that show these spheres at most.
  HWY_INLINE LineIntegral(const LineRays<D>& rays, const LineGrain<T>& grain,
                          const PartSpheres<T>& spheres, Lines<T>& lines)
      : lit_spans(rays, grain),
        rays_(rays),
        scene_(rays.scene()),
        grain_(grain),
        spheres_(spheres),
        lines_(lines),
        silhouettes_(rays) {}

  /// Integrates all lines; `lit_spans` was set to the spheres. False, and nothing done, where one
  /// of them is too near (Silhouettes::set()).
  HWY_NOINLINE bool run(D d) {
    if (!silhouettes_.set(spheres_, grain_.most_span)) return false;
    found_all_ = true;
    lines_.clear_colours(d);
    const auto take = [&](M which, const auto&... values) HWY_ATTR {
      spans_.push(d, which, values...);
      if (spans_.is_full()) part_spans(d);
    };
    for (std::size_t first = 0; first < lines_.count; first += lanes)
      silhouettes_.cross(d, spheres_, first, lines_, take);
    part_spans(d);
    colour_points(d);
    return true;
  }

  /// Whether, in the last run, no colour was clamped and no square shadowed anything else: the
  /// edges that those make are not looked for.
  bool found_all() const { return found_all_; }

  LitSpans<D> lit_spans;

 private:
  static constexpr std::size_t lanes = hn::MaxLanes(D());

  HWY_NOINLINE void part_spans(D d) {
    const auto take = [&](M which, const auto&... values) HWY_ATTR {
      points_.push(d, which, values...);
      if (points_.is_full()) colour_points(d);
    };
    for (std::size_t first = 0; first < spans_.count; first += lanes)
      lit_spans.part(d, spans_, first, spheres_, take);
    spans_.count = 0;
  }

  HWY_NOINLINE void colour_points(D d) {
    for (std::size_t first = 0; first < points_.count; first += lanes) colour_packet(d, first);
    points_.count = 0;
  }

  /// Adds the colours of a packet of points to their lines'.
  HWY_INLINE void colour_packet(D d, std::size_t first) {
    using Point = PointColumn;
    const M active = points_.active(d, first);
    const auto column = [&](typename Point::Name name)
                            HWY_ATTR { return points_.get(d, name, first); };
    const V weight = hn::IfThenElseZero(active, column(Point::weight));
    const ShownSpheres<D> sphere(d, spheres_, hn::IfThenElseZero(active, column(Point::sphere)));
    const V3<V> from = rays_.begin(d, column(Point::right), column(Point::down));
    const V3<V> step = rays_.step(d, column(Point::is_upright));
    const auto sight = sphere.look(d, mul_add(step, column(Point::at), from));
    const Surface<D> surface{sight.at, Rows<D>(d, sphere.material, active)};
    const V3<V> view = negate(sight.direction);
    V3<V> colour;
    if (HWY_UNLIKELY(is_among_squares(d, scene_, surface.at, active))) {
      found_all_ = false;
      colour = shade_fully(d, scene_, surface, view, active);
    } else {
      const hn::RebindToSigned<D> di;
      const auto lights = hn::ConvertTo(di, column(Point::lights));
      const auto reached = [&](const SimdLight<T>& light, const V3<V>& /*towards*/, V /*incidence*/,
                               M facing) HWY_ATTR {
        const auto bit = hn::Set(di, hwy::MakeSigned<T>{1} << (&light - scene_.lights.data()));
        return hn::And(facing, hn::RebindMask(d, hn::TestBit(lights, bit)));
      };
      colour = shade_plainly(d, scene_, surface, view, active, reached);
    }
    const auto* const line = points_.values[Point::line] + first;
    const std::size_t count = std::min(points_.count - first, lanes);
    const V one = hn::Set(d, T(1));
    const V highest = hn::Max(colour.x, hn::Max(colour.y, colour.z));
    found_all_ &= hn::AllTrue(d, hn::Or(hn::Le(highest, one), hn::Not(active)));
    const V3<V> seen = scale(clamped(d, colour), weight);
    alignas(64) T red[lanes];
    alignas(64) T green[lanes];
    alignas(64) T blue[lanes];
    hn::Store(seen.x, d, red);
    hn::Store(seen.y, d, green);
    hn::Store(seen.z, d, blue);
    for (std::size_t i = 0; i < count; ++i) {
      const auto to = static_cast<std::size_t>(line[i]);
      lines_.red[to] += red[i];
      lines_.green[to] += green[i];
      lines_.blue[to] += blue[i];
    }
  }

  const LineRays<D>& rays_;
  const SimdScene<T>& scene_;
  const LineGrain<T>& grain_;
  const PartSpheres<T>& spheres_;
  Lines<T>& lines_;
  bool found_all_ = true;
  Silhouettes<D> silhouettes_;
  Queue<D, SpanColumn::count> spans_;
  Queue<D, PointColumn::count> points_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

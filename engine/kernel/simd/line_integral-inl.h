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
      : lit_spans(rays),
        rays_(rays),
        scene_(rays.scene()),
        grain_(grain),
        spheres_(spheres),
        lines_(lines),
        silhouettes_(rays) {}

  /// Integrates all lines; `lit_spans` was set to the spheres. Where colours are clamped it is done
  /// once more, finely: where they begin to be is a bend, not an edge. False, and nothing done,
  /// where one of the spheres is too near (Silhouettes::set()).
  HWY_INLINE bool run(D d) {
    if (!silhouettes_.set(spheres_, grain_.most_span)) return false;
    found_all_ = true;
    clamped_pixels_ = 0;
    integrate(d, grain_);
    if (clamped_pixels_ != 0 && found_all_) integrate(d, grain_.of_clamped());
    return true;
  }

  /// Whether all edges were found in the last run: no square may have shadowed anything else, and
  /// nothing was so much too bright that it begins to be as at an edge.
  bool found_all() const { return found_all_; }
  /// The pixels, a bit for each, with colours that were clamped in it.
  std::uint32_t clamped_pixels() const { return clamped_pixels_; }

  LitSpans<D> lit_spans;

 private:
  static constexpr std::size_t lanes = hn::MaxLanes(D());
  /// Channels up to here are integrated although they are clamped. Of 384 contracts on scenes whose
  /// lights were made 1.5 to 50 times as bright all are kept; with 6, or a secant less, 1 to 4 not.
  static constexpr T steep = 4;

  HWY_NOINLINE void integrate(D d, const LineGrain<T>& grain) {
    lines_.clear_colours(d);
    const auto take = [&](M which, const auto&... values) HWY_ATTR {
      spans_.push(d, which, values...);
      if (spans_.is_full()) part_spans(d, grain);
    };
    for (std::size_t first = 0; first < lines_.count; first += lanes)
      silhouettes_.cross(d, spheres_, first, lines_, take);
    part_spans(d, grain);
    colour_points(d);
  }

  HWY_NOINLINE void part_spans(D d, const LineGrain<T>& grain) {
    const auto take = [&](M which, const auto&... values) HWY_ATTR {
      points_.push(d, which, values...);
      if (points_.is_full()) colour_points(d);
    };
    for (std::size_t first = 0; first < spans_.count; first += lanes)
      lit_spans.part(d, spans_, first, spheres_, grain, take);
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
    const auto are_all = [&](V most) HWY_ATTR {  // not of what is no number
      return hn::And(hn::Le(colour.x, most),
                     hn::And(hn::Le(colour.y, most), hn::Le(colour.z, most)));
    };
    const M is_clamped = hn::AndNot(are_all(one), active);
    found_all_ &= hn::AllTrue(d, hn::Or(are_all(hn::Set(d, steep)), hn::Not(active)));
    if (HWY_UNLIKELY(!hn::AllFalse(d, is_clamped)))
      for (std::uint64_t rest = bits_of(d, is_clamped); rest != 0; rest &= rest - 1) {
        const auto of_line =
            static_cast<std::size_t>(line[hwy::Num0BitsBelowLS1Bit_Nonzero64(rest)]);
        clamped_pixels_ |= std::uint32_t{1} << of_line % lines_.pixel_count;
      }
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
  std::uint32_t clamped_pixels_ = 0;
  Silhouettes<D> silhouettes_;
  Queue<D, SpanColumn::count> spans_;
  Queue<D, PointColumn::count> points_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

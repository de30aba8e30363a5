// What packets of rays from the eye see.

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// What packets have hit, one after another; nothing, with an id of -1, where a lane has no ray.
template <typename T>
struct Hits {
  alignas(64) T pixel[block_pixels];  ///< its number among those that are queued together
  alignas(64) T direction_x[block_pixels], direction_y[block_pixels], direction_z[block_pixels];
  alignas(64) T t[block_pixels], id[block_pixels], u[block_pixels], v[block_pixels];
  alignas(64) T normal_x[block_pixels], normal_y[block_pixels], normal_z[block_pixels];
  /// What T rounds off of the direction, if paths are carried in double.
  alignas(64) T rest_x[block_pixels], rest_y[block_pixels], rest_z[block_pixels];

  static constexpr T (Hits::*const columns[])[block_pixels] = {
      &Hits::pixel,    &Hits::direction_x, &Hits::direction_y, &Hits::direction_z, &Hits::t,
      &Hits::id,       &Hits::u,           &Hits::v,           &Hits::normal_x,    &Hits::normal_y,
      &Hits::normal_z, &Hits::rest_x,      &Hits::rest_y,      &Hits::rest_z};
};

/// Writes down what the active lanes of the packet from the at-th on have hit.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void store(D d, const V3<V>& direction, const Hit<V>& hit, V pixel, M active,
                      bool has_own_normals, std::size_t at, Hits<T>& to) {
  hn::Store(pixel, d, to.pixel + at);
  hn::Store(direction.x, d, to.direction_x + at);
  hn::Store(direction.y, d, to.direction_y + at);
  hn::Store(direction.z, d, to.direction_z + at);
  hn::Store(hit.t, d, to.t + at);
  hn::Store(hn::IfThenElse(active, hit.id, hn::Set(d, T(-1))), d, to.id + at);
  if (!has_own_normals) return;
  hn::Store(hit.u, d, to.u + at);
  hn::Store(hit.v, d, to.v + at);
  hn::Store(hit.normal.x, d, to.normal_x + at);
  hn::Store(hit.normal.y, d, to.normal_y + at);
  hn::Store(hit.normal.z, d, to.normal_z + at);
}

/// Asks the memory for what occluded() will need of distant lights' grids for the points of
/// `lanes`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void prefetch_light_cells(D d, const PacketScene<T>& scene, const V3<V>& points,
                                     M lanes) {
  for_each_geometry(scene, ChosenPart{.transmits = false},
                    [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                      if constexpr (HasLargeViews<typename PacketLayout<Kind, T>::LightView>)
                        for (const PacketLight<T>& light : scene.lights)
                          prefetch_cells(d, geometry, light, points, lanes);
                    });
}

/// Asks the memory for what shading the packet from the at-th on will need of light grids.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void fetch_for_shading(D d, const PacketScene<T>& scene, const Hits<T>& hits,
                                  std::size_t at) {
  const auto is_hit = hn::Ge(hn::Load(d, hits.id + at), hn::Zero(d));
  if (hn::AllFalse(d, is_hit)) return;
  const auto direction =
      load(d, hits.direction_x + at, hits.direction_y + at, hits.direction_z + at);
  prefetch_light_cells(d, scene, scale(direction, hn::Load(d, hits.t + at)), is_hit);
}

/// The colours of what the packet of hits from the at-th on has hit; the rays that follow are kept
/// in `followed`. `again`, none before, is then the lanes that have to be traced again.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_hit(D d, const EyeRays<D>& eye, const Hits<T>& hits, std::size_t at,
                           const LightSet<T>& light_set, Followed& followed, M& again) {
  const PacketScene<T>& scene = eye.scene();
  const V none = hn::Set(d, T(-1));
  Hit<V> hit{hn::Load(d, hits.t + at), hn::Load(d, hits.id + at), none, none};
  if (scene.has_own_normals) {
    hit.u = hn::Load(d, hits.u + at);
    hit.v = hn::Load(d, hits.v + at);
    hit.normal = load(d, hits.normal_x + at, hits.normal_y + at, hits.normal_z + at);
  }
  const V3<V> direction =
      load(d, hits.direction_x + at, hits.direction_y + at, hits.direction_z + at);
  M is_hit = hn::Ge(hit.id, hn::Zero(d));
  const auto rest = [&]() HWY_ATTR {
    return load(d, hits.rest_x + at, hits.rest_y + at, hits.rest_z + at);
  };
  if constexpr (may_be_inexact<T>)
    if (scene.exact.traces_again()) {
      const M is_near = hn::Lt(hit.t, hn::Set(d, scene.exact.nearest));
      const V3<V> point = scale(direction, hn::IfThenElseZero(is_hit, hit.t));
      again = hn::And(is_hit, hn::Or(is_near, beyond_reach(d, scene.exact, point)));
      is_hit = hn::AndNot(again, is_hit);
    }
  return eye.shade(d, direction, rest, hit, is_hit, hn::Load(d, hits.pixel + at), light_set,
                   followed);
}

/// The colours of what `count` packets have hit, each with its light sets. If `fetches`, what
/// shading a packet will need is fetched before its turn.
template <class D, class Followed, typename T = hn::TFromD<D>>
HWY_NOINLINE void shade_packets(D d, const EyeRays<D>& eye, const Hits<T>& hits, std::size_t count,
                                const LightSets<T>& light_sets, bool fetches, Followed& followed,
                                SampleColours<T>& colours) {
  constexpr std::size_t lanes = hn::MaxLanes(d);
  static_assert(LightSets<T>::rays_in_quarter % lanes == 0);
  const PacketScene<T>& scene = eye.scene();
  if (fetches) fetch_for_shading(d, scene, hits, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * lanes;
    if (fetches && i + 1 < count) fetch_for_shading(d, scene, hits, at + lanes);
    auto again = hn::Lt(hn::Zero(d), hn::Zero(d));
    const auto colour = shade_hit(d, eye, hits, at, light_sets.of_ray(at), followed, again);
    if constexpr (may_be_inexact<T>)
      if (scene.exact.traces_again())
        hn::Store(hn::IfThenElseZero(again, hn::Set(d, T(1))), d, colours.doubt + at);
    store(d, colour, at, colours);
  }
}

/// The pixels of a block in such an order that those of a packet use the same set of places on soft
/// lights and are near each other: all that have the same place in each square of 2 x 2 after one
/// another, so that what they look up stays in the nearest caches, in squares of 4 x 4 of them.
template <class D>
struct PixelsByLightSet {
  static constexpr int across = block_side / 2;
  static constexpr int square = 4;
  static_assert(square * square % PacketShape<D>::lanes == 0);

  int x;
  int y;

  explicit PixelsByLightSet(int i) {
    constexpr int of_place = across * across;
    constexpr int squares_across = across / square;
    const int place = i / of_place;
    const int before = i % of_place / (square * square);  // squares
    const int nth = i % (square * square);
    x = 2 * (before % squares_across * square + nth % square) + place % 2;
    y = 2 * (before / squares_across * square + nth / square) + place / 2;
  }
};

/// As shade_packets() of blocks, in packets of pixels that use one set of places on soft lights.
template <class D, class Followed, typename T = hn::TFromD<D>>
HWY_NOINLINE void shade_by_light_sets(D d, const EyeRays<D>& eye, const Hits<T>* hits,
                                      std::size_t block_count, const LightSets<T>& light_sets,
                                      Followed& followed, SampleColours<T>* colours) {
  using Shape = PacketShape<D>;
  const PacketScene<T>& scene = eye.scene();
  const bool may_doubt = may_be_inexact<T> && scene.exact.traces_again();
  const V3<hn::Vec<D>> background = broadcast(d, scene.background);
  for (std::size_t block = 0; block < block_count; ++block)
    for (std::size_t at = 0; at < block_pixels; at += hn::Lanes(d))
      store(d, background, at, colours[block]);
  // Only what has hit something, so that packets are full of it.
  struct Place {
    std::size_t block;
    std::size_t at;
  } from[block_pixels];
  Hits<T> arranged;
  SampleColours<T> arranged_colours;
  std::size_t count = 0;
  const auto shade = [&](const LightSet<T>& light_set) HWY_ATTR {
    const std::size_t packets = (count + hn::Lanes(d) - 1) / hn::Lanes(d);
    for (std::size_t i = count; i < packets * hn::Lanes(d); ++i)
      for (const auto& column : Hits<T>::columns)
        (arranged.*column)[i] = T(column == &Hits<T>::id ? -1 : 0);
    shade_packets(d, eye, arranged, packets, LightSets<T>(light_set), false, followed,
                  arranged_colours);
    for (std::size_t i = 0; i < count; ++i) {
      SampleColours<T>& to = colours[from[i].block];
      to.red[from[i].at] = arranged_colours.red[i];
      to.green[from[i].at] = arranged_colours.green[i];
      to.blue[from[i].at] = arranged_colours.blue[i];
      if (may_doubt) to.doubt[from[i].at] = arranged_colours.doubt[i];
    }
    count = 0;
  };
  constexpr int in_quarter = block_pixels / 4;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (std::size_t block = 0; block < block_count; ++block)
      for (int nth = in_quarter * quarter; nth < in_quarter * (quarter + 1); ++nth) {
        const PixelsByLightSet<D> place(nth);
        const std::size_t at = Shape::index_of(place.x, place.y);
        if (hits[block].id[at] < 0) continue;
        for (const auto& column : Hits<T>::columns)
          (arranged.*column)[count] = (hits[block].*column)[at];
        from[count++] = {block, at};
        if (count == block_pixels) shade(light_sets.of_quarters[quarter]);
      }
    // One set for all quarters needs no other packets.
    if (light_sets.by_quarters || quarter == 3) shade(light_sets.of_quarters[quarter]);
  }
}

/// The colours of what packets have hit; the rays that follow are queued. If light sets are by
/// quarters, the packets are those of a block, and nothing is fetched.
template <class D, class Followed, typename T = hn::TFromD<D>>
HWY_INLINE void shade_hits(D d, const EyeRays<D>& eye, const Hits<T>& hits, std::size_t count,
                           const LightSets<T>& light_sets, bool fetches, Followed& followed,
                           SampleColours<T>& colours) {
  followed.light_set = light_sets.followed;
  if (HWY_UNLIKELY(light_sets.by_quarters))
    shade_by_light_sets(d, eye, &hits, 1, light_sets, followed, &colours);
  else
    shade_packets(d, eye, hits, count, light_sets, fetches, followed, colours);
}

/// The same with the queue that the scene needs.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void shade_hits(D d, const EyeRays<D>& eye, const Hits<T>& hits, std::size_t count,
                           const LightSets<T>& light_sets, bool fetches, RayQueues<T>& queues,
                           SampleColours<T>& colours) {
  if (HWY_UNLIKELY(eye.scene().transmits))
    shade_hits(d, eye, hits, count, light_sets, fetches, queues.branching, colours);
  else
    shade_hits(d, eye, hits, count, light_sets, fetches, queues.single, colours);
}

/// The colours of what packets of some blocks have hit, by light sets.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void shade_blocks(D d, const EyeRays<D>& eye, const Hits<T>* hits,
                             std::size_t block_count, const LightSets<T>& light_sets,
                             RayQueues<T>& queues, SampleColours<T>* colours) {
  if (may_be_inexact<T> && eye.scene().exact.traces_again())
    for (std::size_t i = 0; i < block_count; ++i) std::fill_n(colours[i].doubt, block_pixels, T(0));
  const auto shade = [&](auto& followed) HWY_ATTR {
    followed.light_set = light_sets.followed;
    shade_by_light_sets(d, eye, hits, block_count, light_sets, followed, colours);
  };
  if (HWY_UNLIKELY(eye.scene().transmits))
    shade(queues.branching);
  else
    shade(queues.single);
}

/// Adds what the rays see that have been queued to the colours of their blocks.
template <typename T>
HWY_INLINE void trace_queued(const PacketScene<T>& scene, RayQueues<T>& queues,
                             SampleColours<T>* colours) {
  if (scene.max_depth == 0) return;
  if (HWY_UNLIKELY(scene.transmits))
    trace_followed(scene, queues.branching, colours);
  else
    trace_followed(scene, queues.single, colours);
}

/// Sets what single rounds off of the directions, which it has, of the packet from the at-th ray
/// on.
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE void set_rests(D d, const PacketScene<double>& scene, const ImagePoints<V>& points,
                            std::size_t at, Hits<float>& hits) {
  const hn::ScalableTag<double> doubles;
  const hn::Rebind<float, decltype(doubles)> singles;
  const EyeRays<decltype(doubles)> eye(doubles, scene);
  alignas(64) float lanes[2][hn::MaxLanes(D())];
  hn::Store(points.right, d, lanes[0]);
  hn::Store(points.down, d, lanes[1]);
  for (std::size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(doubles)) {
    const auto promoted = [&](const float* values) HWY_ATTR {
      return hn::PromoteTo(doubles, hn::Load(singles, values));
    };
    const auto through =
        eye.through(doubles, {points.x, points.y, promoted(lanes[0] + i), promoted(lanes[1] + i)});
    // To a length of 1, by a step of Newton's method from what single makes of it.
    const auto square = dot(through, through);
    const auto rough = hn::PromoteTo(
        doubles, hn::Div(hn::Set(singles, 1.0F), hn::Sqrt(hn::DemoteTo(singles, square))));
    const auto half = hn::Mul(hn::Set(doubles, 0.5), hn::Mul(square, hn::Mul(rough, rough)));
    const auto shorten = hn::Mul(rough, hn::Sub(hn::Set(doubles, 1.5), half));
    const auto set = [&](auto exact, const float* rounded, float* rest) HWY_ATTR {
      const auto off = hn::MulSub(exact, shorten, promoted(rounded + at + i));
      hn::Store(hn::DemoteTo(singles, off), singles, rest + at + i);
    };
    set(through.x, hits.direction_x, hits.rest_x);
    set(through.y, hits.direction_y, hits.rest_y);
    set(through.z, hits.direction_z, hits.rest_z);
  }
}

/// What packets of rays from the eye hit; at most as many rays as a block has pixels. `rays` has
/// count() packets, and for the i-th of them, if is_in(i), image_points(d, i), the active(d, i)
/// lanes, and the candidates(i) of what they go through; image_point(k) of the k-th ray;
/// light_sets(); and first_pixel(), its first pixel's number among those that are queued together.
///
/// `cover`, if there is one, gets 1 where a ray has met something, else 0.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_from_eye(D d, const EyeRays<D>& eye, const Rays& rays, Hits<T>& hits,
                                   T* cover) {
  using V = hn::Vec<D>;
  constexpr int lanes = PacketShape<D>::lanes;
  const PacketScene<T>& scene = eye.scene();
  const V none = hn::Set(d, T(-1));
  for (int i = 0; i < rays.count(); ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * lanes;
    if (!rays.is_in(i)) {
      hn::Store(none, d, hits.id + at);
      continue;
    }
    const ImagePoints<V> points = rays.image_points(d, i);
    const V3<V> direction = eye.direction(d, points);
    const auto active = rays.active(d, i);
    auto&& candidates = rays.candidates(i);
    const Hit<V> hit = eye.intersect(d, candidates, direction, active);
    const V pixel = hn::Iota(d, static_cast<T>(rays.first_pixel() + at));
    store(d, direction, hit, pixel, active, scene.has_own_normals, at, hits);
    if constexpr (may_be_inexact<T>)
      if (scene.exact.carries_paths) set_rests(d, *scene.exact.scene, points, at, hits);
    if (cover != nullptr)
      hn::Store(hn::IfThenElseZero(hn::Ge(hit.id, hn::Zero(d)), hn::Set(d, T(1))), d, cover + at);
  }
}

/// The colours that packets see, as intersect_from_eye() has them, not yet clamped, but for the
/// rays that follow, which are queued. If `fetches`, what shading a packet will need is fetched
/// before its turn.
///
/// All packets are intersected before any is shaded: chains of dependent operations stay short, and
/// the processor overlaps several packets.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_NOINLINE void trace_from_eye(D d, const EyeRays<D>& eye, const Rays& rays, bool fetches,
                                 RayQueues<T>& queues, SampleColours<T>& colours, T* cover) {
  Hits<T> hits;
  intersect_from_eye(d, eye, rays, hits, cover);
  if (may_be_inexact<T> && eye.scene().exact.traces_again())
    std::fill_n(colours.doubt, block_pixels, T(0));
  shade_hits(d, eye, hits, static_cast<std::size_t>(rays.count()), rays.light_sets(), fetches,
             queues, colours);
}

/// Traces those of some blocks' samples again that are doubtful once all is known: see
/// trace_doubtful_again().
template <class D, class RaysOf, class CoverOf, typename T = hn::TFromD<D>>
HWY_INLINE void trace_doubtful(D d, const PacketScene<T>& scene, std::size_t block_count,
                               const RaysOf& rays_of, const CoverOf& cover_of,
                               SampleColours<T>* colours) {
  if constexpr (may_be_inexact<T>)
    if (scene.exact.traces_again() && !rays_of(0).light_sets().followed.is_recorded())
      trace_doubtful_again(d, *scene.exact.scene, block_count, rays_of, cover_of, colours);
}

/// The whole colours of packets by themselves.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void trace_packets(D d, const EyeRays<D>& eye, const Rays& rays, bool fetches,
                              RayQueues<T>& queues, SampleColours<T>& colours, T* cover) {
  trace_from_eye(d, eye, rays, fetches, queues, colours, cover);
  trace_queued(eye.scene(), queues, &colours);
  trace_doubtful(
      d, eye.scene(), 1, [&](std::size_t) -> const Rays& { return rays; },
      [&](std::size_t) { return cover; }, &colours);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

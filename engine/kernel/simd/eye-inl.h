// What packets of rays from the eye see.

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// What packets have hit, one after another.
template <typename T>
struct Hits {
  alignas(64) T direction_x[block_pixels], direction_y[block_pixels], direction_z[block_pixels];
  alignas(64) T t[block_pixels], id[block_pixels], u[block_pixels], v[block_pixels];
  alignas(64) T normal_x[block_pixels], normal_y[block_pixels], normal_z[block_pixels];

  static constexpr T (Hits::*const columns[])[block_pixels] = {
      &Hits::direction_x, &Hits::direction_y, &Hits::direction_z, &Hits::t,        &Hits::id,
      &Hits::u,           &Hits::v,           &Hits::normal_x,    &Hits::normal_y, &Hits::normal_z};
};

/// Asks the memory for what occluded() will need of distant lights' grids for the points of
/// `lanes`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void prefetch_light_cells(D d, const PacketScene<T>& scene, const V3<V>& points,
                                     M lanes) {
  for_each_geometry(scene,
                    [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                      if constexpr (HasLargeViews<typename PacketLayout<Kind, T>::LightView>)
                        for (const PacketLight<T>& light : scene.lights)
                          prefetch_cells(d, geometry, light, points, lanes);
                    });
}

/// Asks the memory for what shading the i-th packet, if there is one, will need of light grids.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void fetch_for_shading(D d, const PacketScene<T>& scene, const Hits<T>& hits,
                                  const Rays& rays, int i) {
  if (i >= rays.count() || !rays.is_in(i)) return;
  const std::size_t at = static_cast<std::size_t>(i) * PacketShape<D>::lanes;
  const auto hit = hn::And(rays.active(d, i), hn::Ge(hn::Load(d, hits.id + at), hn::Zero(d)));
  const auto direction =
      load(d, hits.direction_x + at, hits.direction_y + at, hits.direction_z + at);
  prefetch_light_cells(d, scene, scale(direction, hn::Load(d, hits.t + at)), hit);
}

/// The colours of what the packet of hits from the at-th on has hit, of the block's pixels `pixel`;
/// the rays that follow are kept in `followed`. Lanes that have to be traced again are taken out of
/// `active`, and are those of `again`.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_hit(D d, const EyeRays<D>& eye, const Hits<T>& hits, std::size_t at, V pixel,
                           M active, const LightSet<T>& light_set, Followed& followed, M& again) {
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
  if constexpr (may_be_inexact<T>)
    if (scene.exact.scene) {
      const M is_hit = hn::And(active, hn::Ge(hit.id, hn::Zero(d)));
      const M is_near = hn::Lt(hit.t, hn::Set(d, scene.exact.nearest));
      const V3<V> point = scale(direction, hn::IfThenElseZero(is_hit, hit.t));
      again = hn::And(is_hit, hn::Or(is_near, beyond_reach(d, scene.exact, point)));
      active = hn::AndNot(again, active);
    }
  return eye.shade(d, direction, hit, active, pixel, light_set, followed);
}

/// The colours of what packets have hit.
template <class D, class Rays, class Followed, typename T = hn::TFromD<D>>
HWY_INLINE void shade_packets(D d, const EyeRays<D>& eye, const Rays& rays, const Hits<T>& hits,
                              bool fetches, Followed& followed, SampleColours<T>& colours) {
  const PacketScene<T>& scene = eye.scene();
  if (fetches) fetch_for_shading(d, scene, hits, rays, 0);
  for (int i = 0; i < rays.count(); ++i) {
    if (fetches) fetch_for_shading(d, scene, hits, rays, i + 1);
    if (!rays.is_in(i)) continue;
    const std::size_t at = static_cast<std::size_t>(i) * PacketShape<D>::lanes;
    const auto pixel = hn::Iota(d, static_cast<T>(at));
    const auto active = rays.active(d, i);
    auto again = hn::AndNot(active, active);
    const auto colour =
        shade_hit(d, eye, hits, at, pixel, active, rays.light_set(), followed, again);
    if constexpr (may_be_inexact<T>)
      if (scene.exact.scene)
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

/// The same of a block, in packets of pixels that use one set of places on soft lights.
template <class D, class Rays, class Followed, typename T = hn::TFromD<D>>
HWY_NOINLINE void shade_by_light_sets(D d, const EyeRays<D>& eye, const Rays& rays,
                                      const Hits<T>& hits, Followed& followed,
                                      SampleColours<T>& colours) {
  using Shape = PacketShape<D>;
  const PacketScene<T>& scene = eye.scene();
  alignas(64) T is_active[block_pixels] = {};
  for (int i = 0; i < rays.count(); ++i)
    if (rays.is_in(i))
      hn::Store(hn::IfThenElseZero(rays.active(d, i), hn::Set(d, T(1))), d,
                is_active + static_cast<std::size_t>(i) * Shape::lanes);
  Hits<T> arranged;
  alignas(64) T pixels[block_pixels];
  alignas(64) T arranged_active[block_pixels];
  for (std::size_t to = 0; to < block_pixels; ++to) {
    const PixelsByLightSet<D> place(static_cast<int>(to));
    const std::size_t from = Shape::index_of(place.x, place.y);
    pixels[to] = static_cast<T>(from);
    arranged_active[to] = is_active[from];
    for (const auto& column : Hits<T>::columns) (arranged.*column)[to] = (hits.*column)[from];
  }
  for (std::size_t at = 0; at < block_pixels; at += Shape::lanes) {
    const auto active = hn::Gt(hn::Load(d, arranged_active + at), hn::Zero(d));
    if (hn::AllFalse(d, active)) continue;
    const PixelsByLightSet<D> place(static_cast<int>(at));
    const LightSet<T> light_set = rays.light_set_at(place.y % 2 * 2 + place.x % 2);
    auto again = hn::AndNot(active, active);
    const auto colour = shade_hit(d, eye, arranged, at, hn::Load(d, pixels + at), active, light_set,
                                  followed, again);
    alignas(64) T values[4][Shape::lanes];
    hn::Store(colour.x, d, values[0]);
    hn::Store(colour.y, d, values[1]);
    hn::Store(colour.z, d, values[2]);
    hn::Store(hn::IfThenElseZero(again, hn::Set(d, T(1))), d, values[3]);
    for (std::size_t lane = 0; lane < Shape::lanes; ++lane) {
      const auto pixel = static_cast<std::size_t>(pixels[at + lane]);
      colours.red[pixel] = values[0][lane];
      colours.green[pixel] = values[1][lane];
      colours.blue[pixel] = values[2][lane];
      if constexpr (may_be_inexact<T>)
        if (scene.exact.scene) colours.doubt[pixel] = values[3][lane];
    }
  }
}

/// The colours of what packets have hit; the rays that follow are kept in `followed`.
template <class D, class Rays, class Followed, typename T = hn::TFromD<D>>
HWY_INLINE void shade_hits(D d, const EyeRays<D>& eye, const Rays& rays, const Hits<T>& hits,
                           bool fetches, Followed& followed, SampleColours<T>& colours) {
  followed.light_set = rays.light_set();
  if constexpr (Rays::are_of_block)
    if (HWY_UNLIKELY(eye.scene().light_sets > 1))
      return shade_by_light_sets(d, eye, rays, hits, followed, colours);
  shade_packets(d, eye, rays, hits, fetches, followed, colours);
}

/// The same, and what the rays that follow see.
template <class D, class Rays, class Followed, typename T = hn::TFromD<D>>
HWY_NOINLINE void shade_and_follow(D d, const EyeRays<D>& eye, const Rays& rays,
                                   const Hits<T>& hits, bool fetches, Followed& followed,
                                   SampleColours<T>& colours) {
  shade_hits(d, eye, rays, hits, fetches, followed, colours);
  if (eye.scene().max_depth > 0) trace_followed(eye.scene(), followed, colours);
}

/// The colours that packets of rays from the eye see, not yet clamped; at most as many as a block
/// has pixels. If `fetches`, what shading a packet will need is fetched before its turn. `rays` has
/// count() packets, and for the i-th of them, if is_in(i), direction(d, i), the active(d, i) lanes,
/// and the candidates(i) of what they go through; and image_point(k) of the k-th ray.
///
/// All packets are intersected before any is shaded: chains of dependent operations stay short, and
/// the processor overlaps several packets.
///
/// `cover`, if there is one, gets 1 where a ray has met something, else 0.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void trace_packets(D d, const EyeRays<D>& eye, const Rays& rays, bool fetches,
                              RayQueues<T>& queues, SampleColours<T>& colours, T* cover) {
  using V = hn::Vec<D>;
  constexpr int lanes = PacketShape<D>::lanes;
  const PacketScene<T>& scene = eye.scene();
  Hits<T> hits;
  for (int i = 0; i < rays.count(); ++i) {
    if (!rays.is_in(i)) continue;
    const std::size_t at = static_cast<std::size_t>(i) * lanes;
    const V3<V> direction = rays.direction(d, i);
    auto&& candidates = rays.candidates(i);
    const Hit<V> hit = eye.intersect(d, candidates, direction, rays.active(d, i));
    hn::Store(direction.x, d, hits.direction_x + at);
    hn::Store(direction.y, d, hits.direction_y + at);
    hn::Store(direction.z, d, hits.direction_z + at);
    hn::Store(hit.t, d, hits.t + at);
    hn::Store(hit.id, d, hits.id + at);
    if (cover != nullptr)
      hn::Store(hn::IfThenElseZero(hn::Ge(hit.id, hn::Zero(d)), hn::Set(d, T(1))), d, cover + at);
    if (!scene.has_own_normals) continue;
    hn::Store(hit.u, d, hits.u + at);
    hn::Store(hit.v, d, hits.v + at);
    hn::Store(hit.normal.x, d, hits.normal_x + at);
    hn::Store(hit.normal.y, d, hits.normal_y + at);
    hn::Store(hit.normal.z, d, hits.normal_z + at);
  }
  const bool may_doubt = may_be_inexact<T> && scene.exact.scene;
  if (may_doubt) std::fill_n(colours.doubt, block_pixels, T(0));
  if (HWY_UNLIKELY(scene.transmits))
    shade_and_follow(d, eye, rays, hits, fetches, queues.branching, colours);
  else
    shade_and_follow(d, eye, rays, hits, fetches, queues.single, colours);
  if constexpr (may_be_inexact<T>)
    if (may_doubt && !rays.light_set().is_recorded())
      trace_doubtful_again(d, *scene.exact.scene, rays, colours, cover);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

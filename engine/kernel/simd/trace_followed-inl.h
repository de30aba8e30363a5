// What followed rays see, and those that follow them: one where something mirrors, two where it
// lets rays through as well.

#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Rays that count for less are left out.
template <class Followed, typename T>
inline constexpr T least_weight = Followed::branches ? static_cast<T>(least_ray_weight)
                                                     : std::numeric_limits<T>::denorm_min();

/// Where mirrors send rays of such directions.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> mirrored(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                          const V3<V>& incoming) {
  const auto reflected = [&](const V3<V>& normal) HWY_ATTR {
    const V twice = hn::Mul(hn::Set(d, T(-2)), dot(incoming, normal));
    return mul_add(normal, twice, incoming);
  };
  V3<V> direction = reflected(surface.normal);
  if (!scene.corners.empty()) {  // above the surface
    const M above = hn::Gt(dot(direction, surface.at.normal), hn::Zero(d));
    direction = select(above, direction, reflected(surface.at.normal));
  }
  return unit(d, direction);
}

/// Sets `doubt`, if somebody wants it, to what the colours that a packet sees may make their
/// pixels' be off by, and takes the lanes of which that is too much out of `goes_on`. Returns the
/// errors of the rays that follow.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE PathError<V> note_errors(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                                      const Packet<V>& packet, V t, M is_hit, M& goes_on,
                                      V* doubt) {
  const SurfaceError<V> at = surface_error(d, scene, surface, packet.error, packet.direction,
                                           hn::IfThenElseZero(is_hit, t), is_hit);
  if (doubt != nullptr) {
    *doubt = hn::IfThenElseZero(
        is_hit, hn::Mul(packet.weight, colour_error(d, scene, surface, packet.error, at)));
    goes_on = hn::And(goes_on, hn::Le(*doubt, hn::Set(d, static_cast<T>(most_colour_error))));
  }
  return error_beyond(d, packet.error, at);
}

/// Adds the rays that go on through the lanes of `clear`, at least one, and to `reflectivity` what
/// does not.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE void refract(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                          const Packet<V>& packet, const PathError<V>& error,
                          const Rows<D, GlassRow<T>>& glass, M clear, V& reflectivity,
                          Followed& followed) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const V ior = glass(d, &GlassRow<T>::ior);
  const V transparency = glass(d, &GlassRow<T>::transparency);
  const V3<V>& direction = packet.direction;
  const M bends = hn::Ge(surface.at.u, zero);
  const V index = hn::IfThenElse(hn::Gt(surface.at.u, zero), ior, hn::Div(one, ior));
  const auto bent = scene.corners.empty()
                        ? refracted(d, index, direction, surface.at.normal)
                        : refracted(d, index, direction, surface.normal, surface.at.normal);
  const M by_angle = hn::Or(bent.is_total, hn::Gt(glass(d, &GlassRow<T>::fresnel), zero));
  const V turned_back = hn::IfThenElseZero(hn::And(bends, by_angle), bent.reflectance);
  const V share = hn::IfThenElseZero(clear, transparency);
  reflectivity = hn::MulAdd(share, turned_back, reflectivity);

  Packet<V> on = packet;
  on.from = surface.at;
  on.from.normal = negate(surface.at.normal);
  on.error = error;
  on.direction = select(bends, bent.direction, direction);
  on.weight = hn::Mul(packet.weight, hn::Mul(share, hn::Sub(one, turned_back)));
  on.solids = depth_beyond(d, scene, surface, clear, packet.solids);
  on.followers = hn::Sub(packet.followers, one);
  const M counts = hn::And(clear, hn::Ge(on.weight, hn::Set(d, least_weight<Followed, T>)));
  if (!hn::AllFalse(d, counts)) followed.add(d, on, counts, false);
}

/// What a packet's rays meet.
template <class Followed, class D, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE Hit<V> find_hits(D d, const PacketScene<T>& scene, const Packet<V>& packet, M active) {
  const V far_away = hn::Set(d, std::numeric_limits<T>::max());
  if constexpr (Followed::branches)
    return find_within(d, scene, packet.from, packet.direction, far_away, packet.solids, active);
  else
    return find_followed(d, scene, packet.from, packet.direction, far_away, active);
}

/// What stands before lights for a packet's points.
template <class Followed, class D, class V = hn::Vec<D>>
HWY_INLINE auto between_lights(D d, const Packet<V>& packet) {
  if constexpr (Followed::branches)
    return LightThroughSurfaces(d, packet.solids);
  else
    return OpaqueSurfaces();
}

/// The colours that a packet sees, and in `doubt`, if somebody wants it, by how much they may make
/// their pixels' be off; the rays that follow are kept in `followed`.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_packet(D d, const PacketScene<T>& scene, const Packet<V>& packet,
                              const Hit<V>& hit, M active, Followed& followed, V* doubt) {
  const V zero = hn::Zero(d);
  const M is_hit = hn::And(active, hn::Ge(hit.id, zero));
  const V3<V> background = broadcast(d, scene.background);
  if (hn::AllFalse(d, is_hit)) return background;
  Surface<D> surface = surface_at(d, scene, packet.from, packet.direction, hit, is_hit);
  if constexpr (Followed::branches)
    tell_sides(d, scene, packet.direction, is_hit, hn::Gt(packet.solids, zero), surface);
  const V3<V> colour = select(is_hit,
                              shade(d, scene, surface, negate(packet.direction), is_hit,
                                    packet.light_set, between_lights<Followed>(d, packet)),
                              background);
  if (scene.max_depth == 0) return colour;

  V reflectivity = surface.material(d, &MaterialRow<T>::reflectivity);
  M goes_on = hn::And(is_hit, hn::Gt(packet.followers, zero));
  if constexpr (!Followed::branches) goes_on = hn::And(goes_on, hn::Gt(reflectivity, zero));
  PathError<V> error = packet.error;
  if constexpr (may_be_inexact<T>)
    if (scene.exact.scene && (doubt != nullptr || !hn::AllFalse(d, goes_on)))
      error = note_errors(d, scene, surface, packet, hit.t, is_hit, goes_on, doubt);
  if (hn::AllFalse(d, goes_on)) return colour;

  if constexpr (Followed::branches) {
    const Rows<D, GlassRow<T>> glass = glass_of(d, scene, surface.at.id, is_hit);
    const M clear = hn::And(goes_on, hn::Gt(glass(d, &GlassRow<T>::transparency), zero));
    if (!hn::AllFalse(d, clear))
      refract(d, scene, surface, packet, error, glass, clear, reflectivity, followed);
  }
  const V weight = hn::Mul(packet.weight, reflectivity);
  const M mirrors = hn::And(goes_on, hn::Ge(weight, hn::Set(d, least_weight<Followed, T>)));
  if (hn::AllFalse(d, mirrors)) return colour;
  const V3<V> direction = mirrored(d, scene, surface, packet.direction);
  const V followers = hn::Sub(packet.followers, hn::Set(d, T(1)));
  followed.add(
      d, Packet<V>{surface.at, direction, weight, packet.pixel, followers, packet.solids, error},
      mirrors, true);
  return colour;
}

/// Adds the colours that a packet's rays see to their pixels, and by how much they may be off.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void add_to_pixels(D d, const PacketScene<T>& scene, const V3<V>& colour, V doubt,
                              const Packet<V>& packet, M active, SampleColours<T>* colours) {
  alignas(64) T pixels[hn::MaxLanes(D())];
  alignas(64) T weighted[4][hn::MaxLanes(D())];
  hn::Store(packet.pixel, d, pixels);
  hn::Store(hn::Mul(colour.x, packet.weight), d, weighted[0]);
  hn::Store(hn::Mul(colour.y, packet.weight), d, weighted[1]);
  hn::Store(hn::Mul(colour.z, packet.weight), d, weighted[2]);
  hn::Store(doubt, d, weighted[3]);
  const bool may_doubt = may_be_inexact<T> && scene.exact.scene;
  const std::size_t count = count_true(d, active);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto of_all = static_cast<std::size_t>(pixels[lane]);
    SampleColours<T>& to = colours[of_all / block_pixels];
    const std::size_t pixel = of_all % block_pixels;
    to.red[pixel] += weighted[0][lane];
    to.green[pixel] += weighted[1][lane];
    to.blue[pixel] += weighted[2][lane];
    if (may_doubt) to.doubt[pixel] += weighted[3][lane];
  }
}

/// Follows rays to the scene's depth and adds what they see to the colours of their blocks.
template <class Followed, typename T>
HWY_NOINLINE void trace_followed(const PacketScene<T>& scene, Followed& followed,
                                 SampleColours<T>* colours) {
  const hn::ScalableTag<T> d;
  while (const std::size_t count = followed.take()) {
    const bool are_found = followed.find_at_once(scene);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      const auto active = hn::FirstN(d, count - i);
      const auto packet = followed.packet(d, i, active);
      const auto hit =
          are_found ? followed.hits(d, scene, i) : find_hits<Followed>(d, scene, packet, active);
      auto doubt = hn::Zero(d);
      const auto colour = shade_packet(d, scene, packet, hit, active, followed, &doubt);
      add_to_pixels(d, scene, colour, doubt, packet, active, colours);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

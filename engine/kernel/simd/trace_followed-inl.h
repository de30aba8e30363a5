// What followed rays see, and those that follow them: one where something mirrors, two where it
// lets rays through as well.

#include <cstddef>
#include <limits>

#include "engine/math/ray.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Rays that count for less are left out.
template <class Followed, typename T>
inline constexpr T least_weight = Followed::branches ? static_cast<T>(least_ray_weight)
                                                     : std::numeric_limits<T>::denorm_min();

/// Where mirrors send rays of such directions; of about their length, 1.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> reflected_at(D d, const PacketScene<T>& scene, const Meeting<V>& met,
                              const V3<V>& incoming) {
  const auto reflected = [&](const V3<V>& normal) HWY_ATTR {
    const V twice = hn::Mul(hn::Set(d, T(-2)), dot(incoming, normal));
    return mul_add(normal, twice, incoming);
  };
  V3<V> direction = reflected(met.shading_normal);
  if (!scene.corners.empty()) {  // above the surface
    const M above = hn::Gt(dot(direction, met.normal), hn::Zero(d));
    direction = select(above, direction, reflected(met.normal));
  }
  return direction;
}

/// Refracted by what packets have met; `index` is that of here over there.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE auto refracted_at(D d, const PacketScene<T>& scene, V index, const Meeting<V>& met,
                             const V3<V>& incoming) {
  return scene.corners.empty() ? refracted(d, index, incoming, met.normal)
                               : refracted(d, index, incoming, met.shading_normal, met.normal);
}

/// What of packets goes on through surfaces, and how.
template <class V, class M>
struct Refraction {
  M clear;          ///< lanes of which something does
  M bends;          ///< that go into or out of what has an inside
  V3<V> direction;  ///< of what goes on
  V share;          ///< of the light
  V reflectivity;   ///< what is turned back where it would bend
};

/// Of the lanes of `goes_on`, at least one, which have met surfaces on that `side`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE Refraction<V, M> refraction_at(D d, const PacketScene<T>& scene,
                                            const Surface<D>& surface, V side,
                                            const V3<V>& direction, M goes_on) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const Rows<D, GlassRow<T>> glass = glass_of(d, scene, surface.at.id, goes_on);
  const V ior = glass(d, &GlassRow<T>::ior);
  const V transparency = glass(d, &GlassRow<T>::transparency);
  const M clear = hn::And(goes_on, hn::Gt(transparency, zero));
  const M bends = hn::Ge(side, zero);
  const V index = hn::IfThenElse(hn::Gt(side, zero), ior, hn::Div(one, ior));
  if (hn::AllFalse(d, clear)) return {clear, bends, direction, zero, zero};
  const auto bent = refracted_at(d, scene, index, surface.meeting(), direction);
  const M by_angle = hn::Or(bent.is_total, hn::Gt(glass(d, &GlassRow<T>::fresnel), zero));
  const V turned_back = hn::IfThenElseZero(hn::And(bends, by_angle), bent.reflectance);
  const V share = hn::IfThenElseZero(clear, transparency);
  return {clear, bends, select(bends, bent.direction, direction),
          hn::Mul(share, hn::Sub(one, turned_back)), hn::Mul(share, turned_back)};
}

/// Adds the rays that follow a packet through surfaces, from `point` in `direction`; `way` as
/// RayBatch::add() has it.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE void add_refracted(D d, const PacketScene<T>& scene, const Surface<D>& surface, V side,
                                const Packet<V>& packet, const Refraction<V, M>& refraction,
                                const V3<V>& point, const V3<V>& direction, const WayTo<V>* way,
                                Followed& followed) {
  const M clear = refraction.clear;
  const V weight = hn::Mul(packet.weight, refraction.share);
  const M counts = hn::And(clear, hn::Ge(weight, hn::Set(d, least_weight<Followed, T>)));
  if (hn::AllFalse(d, counts)) return;
  Packet<V> on = packet;
  on.from = surface.at;
  on.from.point = point;
  on.from.normal = negate(surface.at.normal);
  on.direction = direction;
  on.weight = weight;
  on.solids = depth_beyond(d, scene, surface.at.id, side, clear, packet.solids);
  on.followers = hn::Sub(packet.followers, hn::Set(d, T(1)));
  followed.add_refracted(d, on, way, refraction.bends, counts);
}

/// The same of rays that surfaces of such reflectivity mirror.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void add_mirrored(D d, const Surface<D>& surface, const Packet<V>& packet, M goes_on,
                             V reflectivity, const V3<V>& point, const V3<V>& direction,
                             const WayTo<V>* way, Followed& followed) {
  const V weight = hn::Mul(packet.weight, reflectivity);
  const M mirrors = hn::And(goes_on, hn::Ge(weight, hn::Set(d, least_weight<Followed, T>)));
  if (hn::AllFalse(d, mirrors)) return;
  const V followers = hn::Sub(packet.followers, hn::Set(d, T(1)));
  const RayOrigin<V>& at = surface.at;
  followed.add_mirrored(d,
                        Packet<V>{{point, at.normal, at.id, at.u, at.v},
                                  direction,
                                  weight,
                                  packet.pixel,
                                  followers,
                                  packet.solids},
                        way, mirrors);
}

/// Adds the rays that follow the lanes of `goes_on`, at least one. With a `way`, where paths are
/// carried in double, how they go on is computed later, once they turn.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void add_followers(D d, const PacketScene<T>& scene, const Packet<V>& packet,
                              const Surface<D>& surface, V side, M goes_on, V reflectivity,
                              const WayTo<V>* way, Followed& followed) {
  const V3<V>& point = way ? packet.from.point : surface.at.point;
  V3<V> mirrored = packet.direction;
  if (!way) mirrored = unit(d, reflected_at(d, scene, surface.meeting(), packet.direction));
  if constexpr (Followed::branches) {
    const auto refraction = refraction_at(d, scene, surface, side, packet.direction, goes_on);
    const V3<V>& direction = way ? packet.direction : refraction.direction;
    reflectivity = hn::Add(reflectivity, refraction.reflectivity);
    add_refracted(d, scene, surface, side, packet, refraction, point, direction, way, followed);
  }
  add_mirrored(d, surface, packet, goes_on, reflectivity, point, mirrored, way, followed);
}

/// The same where paths are carried in double; `rest` is what single rounds off of the packet. Out
/// of line: it would take registers from where they are not.
template <class D, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_NOINLINE void add_carried_followers(D d, const PacketScene<float>& scene,
                                        const Packet<V>& packet, const RayRest<V>& rest, V t,
                                        const Surface<D>& surface, V side, M goes_on,
                                        V reflectivity, Followed& followed) {
  const WayTo<V> way{rest, t, side, packet.from.id, packet.from.normal};
  add_followers(d, scene, packet, surface, side, goes_on, reflectivity, &way, followed);
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

/// The colours that a packet sees, and in `doubt`, if somebody wants it, what counts in their
/// pixels of those beyond a light's reach; the rays that follow are kept in `followed`. rest() is
/// what single rounds off of its rays, if paths are carried in double.
template <class D, class Rest, class Followed, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_packet(D d, const PacketScene<T>& scene, const Packet<V>& packet,
                              const Rest& rest, const Hit<V>& hit, M active, Followed& followed,
                              V* doubt) {
  const V zero = hn::Zero(d);
  const M is_hit = hn::And(active, hn::Ge(hit.id, zero));
  const V3<V> background = broadcast(d, scene.background);
  if (hn::AllFalse(d, is_hit)) return background;
  Surface<D> surface = surface_at(d, scene, packet.from, packet.direction, hit, is_hit);
  V side = zero;
  if constexpr (Followed::branches)
    side = tell_sides(d, scene, packet.direction, is_hit, hn::Gt(packet.solids, zero), surface);
  const V3<V> colour = select(is_hit,
                              shade(d, scene, surface, negate(packet.direction), is_hit,
                                    packet.light_set, between_lights<Followed>(d, packet)),
                              background);
  if (scene.max_depth == 0) return colour;

  M goes_on = hn::And(is_hit, hn::Gt(packet.followers, zero));
  if constexpr (may_be_inexact<T>)
    if (doubt != nullptr && !scene.exact.lamps.empty()) {
      const M is_beyond = hn::And(is_hit, beyond_reach(d, scene.exact, surface.at.point));
      *doubt = hn::IfThenElseZero(is_beyond, packet.weight);
      goes_on = hn::AndNot(is_beyond, goes_on);
    }
  const V reflectivity = surface.material(d, &MaterialRow<T>::reflectivity);
  if constexpr (!Followed::branches) goes_on = hn::And(goes_on, hn::Gt(reflectivity, zero));
  if (hn::AllFalse(d, goes_on)) return colour;

  if constexpr (may_be_inexact<T>)
    if (scene.exact.carries_paths) {
      add_carried_followers(d, scene, packet, rest(), hit.t, surface, side, goes_on, reflectivity,
                            followed);
      return colour;
    }
  const WayTo<V>* const none = nullptr;
  add_followers(d, scene, packet, surface, side, goes_on, reflectivity, none, followed);
  return colour;
}

/// Adds the colours that a packet's rays see to their pixels, and what is to be doubted of them.
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
  const bool may_doubt = may_be_inexact<T> && scene.exact.traces_again();
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
  while (const std::size_t count = followed.take(scene)) {
    const bool are_found = followed.find_at_once(scene);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      const auto active = hn::FirstN(d, count - i);
      const auto packet = followed.packet(d, i, active);
      const auto hit =
          are_found ? followed.hits(d, scene, i) : find_hits<Followed>(d, scene, packet, active);
      auto doubt = hn::Zero(d);
      const auto rest = [&]() HWY_ATTR { return followed.rest(d, i, active); };
      const auto colour = shade_packet(d, scene, packet, rest, hit, active, followed, &doubt);
      add_to_pixels(d, scene, colour, doubt, packet, active, colours);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

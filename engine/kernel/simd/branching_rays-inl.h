// Rays in scenes that let them through: where a surface mirrors as well, a ray has two followers.
//
// Those that wait are a stack, of which the latest go first: it holds a block's rays and a few for
// each that has followed, however many there are in all.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/math/ray.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

template <typename T>
inline constexpr T least_weight = static_cast<T>(least_ray_weight);

/// A packet of rays that may be inside of things.
template <class V>
struct InnerPacket {
  Packet<V> rays;
  V solids;     ///< of how many of these they are inside
  V followers;  ///< how many rays may still follow, one after another
};

/// Rays to be followed, the latest on top.
template <typename T>
class RayStack {
 public:
  std::size_t light_set = 0;  ///< of all: of places on soft lights

  std::size_t count() const { return count_; }

  /// Adds the lanes of `mask`.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void push(D d, const InnerPacket<V>& packet, M mask) {
    if (hn::AllFalse(d, mask)) return;
    const auto first_of_mask = compressing_order(d, mask);
    const Packet<V>& rays = packet.rays;
    const V values[column_count] = {rays.direction.x,   rays.direction.y,   rays.direction.z,
                                    rays.from.point.x,  rays.from.point.y,  rays.from.point.z,
                                    rays.from.normal.x, rays.from.normal.y, rays.from.normal.z,
                                    rays.from.id,       rays.from.u,        rays.from.v,
                                    rays.weight,        rays.pixel,         packet.solids,
                                    packet.followers,   rays.error.place,   rays.error.direction};
    const std::size_t needed = count_ + hn::Lanes(d);
    for (std::size_t i = 0; i < column_count; ++i) {
      if (columns_[i].size() < needed) columns_[i].resize(2 * needed);
      hn::StoreU(hn::TableLookupLanes(values[i], first_of_mask), d, columns_[i].data() + count_);
    }
    count_ += count_true(d, mask);
  }

  /// Takes the topmost: the first lanes, as many as `active` says. The others hold zeros.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE InnerPacket<V> pop(D d, hn::Mask<D>& active) {
    const std::size_t taken = std::min(count_, hn::Lanes(d));
    count_ -= taken;
    active = hn::FirstN(d, taken);
    const auto at = [&](std::size_t column) HWY_ATTR {
      return hn::IfThenElseZero(active, hn::LoadU(d, columns_[column].data() + count_));
    };
    return {{{{at(3), at(4), at(5)}, {at(6), at(7), at(8)}, at(9), at(10), at(11)},
             {at(0), at(1), at(2)},
             at(12),
             at(13),
             {at(16), at(17)},
             light_set},
            at(14),
            at(15)};
  }

 private:
  static constexpr std::size_t column_count = 18;
  std::array<std::vector<T>, column_count> columns_;
  std::size_t count_ = 0;
};

/// Adds the rays that go on through the lanes of `clear`, at least one, and to `reflectivity` what
/// does not.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void refract(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                          const InnerPacket<V>& packet, const PathError<V>& error,
                          const Rows<D, GlassRow<T>>& glass, M clear, V& reflectivity,
                          RayStack<T>& stack) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const V ior = glass(d, &GlassRow<T>::ior);
  const V transparency = glass(d, &GlassRow<T>::transparency);
  const V3<V>& direction = packet.rays.direction;
  const M bends = hn::Ge(surface.at.u, zero);
  const V index = hn::IfThenElse(hn::Gt(surface.at.u, zero), ior, hn::Div(one, ior));
  const auto bent = scene.corners.empty()
                        ? refracted(d, index, direction, surface.at.normal)
                        : refracted(d, index, direction, surface.normal, surface.at.normal);
  const M by_angle = hn::Or(bent.is_total, hn::Gt(glass(d, &GlassRow<T>::fresnel), zero));
  const V turned_back = hn::IfThenElseZero(hn::And(bends, by_angle), bent.reflectance);
  const V share = hn::IfThenElseZero(clear, transparency);
  reflectivity = hn::MulAdd(share, turned_back, reflectivity);

  InnerPacket<V> on = packet;
  on.rays.from = surface.at;
  on.rays.from.normal = negate(surface.at.normal);
  on.rays.error = error;
  on.rays.direction = select(bends, bent.direction, direction);
  on.rays.weight = hn::Mul(packet.rays.weight, hn::Mul(share, hn::Sub(one, turned_back)));
  on.solids = depth_beyond(d, scene, surface, clear, packet.solids);
  on.followers = hn::Sub(packet.followers, one);
  stack.push(d, on, hn::And(clear, hn::Ge(on.rays.weight, hn::Set(d, least_weight<T>))));
}

/// The colours that a packet sees; the rays that follow go on the stack.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE V3<V> shade_packet(D d, const PacketScene<T>& scene, const InnerPacket<V>& packet,
                                const Hit<V>& hit, M active, RayStack<T>& stack, V* doubt) {
  const V zero = hn::Zero(d);
  const Packet<V>& rays = packet.rays;
  const M is_hit = hn::And(active, hn::Ge(hit.id, zero));
  const V3<V> background = broadcast(d, scene.background);
  if (hn::AllFalse(d, is_hit)) return background;
  Surface<D> surface = surface_at(d, scene, rays.from, rays.direction, hit, is_hit);
  tell_sides(d, scene, rays.direction, is_hit, hn::Gt(packet.solids, zero), surface);
  LightThroughSurfaces<D> between(d, packet.solids);
  const V3<V> colour = select(
      is_hit, shade(d, scene, surface, negate(rays.direction), is_hit, rays.light_set, between),
      background);
  PathError<V> error = rays.error;
  M goes_on = hn::And(is_hit, hn::Gt(packet.followers, zero));
  if constexpr (may_be_inexact<T>)
    if (scene.exact.scene)
      error = note_errors(d, scene, surface, rays, hit.t, is_hit, goes_on, doubt);
  if (hn::AllFalse(d, goes_on)) return colour;

  const Rows<D, GlassRow<T>> glass = glass_of(d, scene, surface.at.id, is_hit);
  V reflectivity = surface.material(d, &MaterialRow<T>::reflectivity);
  const M clear = hn::And(goes_on, hn::Gt(glass(d, &GlassRow<T>::transparency), zero));
  if (!hn::AllFalse(d, clear))
    refract(d, scene, surface, packet, error, glass, clear, reflectivity, stack);
  InnerPacket<V> back = packet;
  back.rays.weight = hn::Mul(rays.weight, reflectivity);
  const M mirrors = hn::And(goes_on, hn::Ge(back.rays.weight, hn::Set(d, least_weight<T>)));
  if (hn::AllFalse(d, mirrors)) return colour;
  back.rays.from = surface.at;
  back.rays.error = error;
  back.rays.direction = mirrored(d, scene, surface, rays.direction);
  back.followers = hn::Sub(packet.followers, hn::Set(d, T(1)));
  stack.push(d, back, mirrors);
  return colour;
}

/// Follows rays to the scene's depth and adds what they see.
template <typename T>
void trace_followed(const PacketScene<T>& scene, RayStack<T>& stack, SampleColours<T>& colours) {
  const hn::ScalableTag<T> d;
  while (stack.count() > 0) {
    hn::Mask<decltype(d)> active;
    const auto packet = stack.pop(d, active);
    const auto& rays = packet.rays;
    const auto far_away = hn::Set(d, std::numeric_limits<T>::max());
    const auto hit =
        find_within(d, scene, rays.from, rays.direction, far_away, packet.solids, active);
    auto doubt = hn::Zero(d);
    const auto colour = shade_packet(d, scene, packet, hit, active, stack, &doubt);
    add_to_pixels(d, scene, colour, doubt, rays, active, colours);
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

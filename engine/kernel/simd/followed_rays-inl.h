// Rays that follow others: those that still matter side by side, a step of all at a time.

#include <limits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// A packet of rays that follow others, or come from the eye.
template <class V>
struct Packet {
  RayOrigin<V> from;
  V3<V> direction;
  V weight;  ///< of what they see in their pixels
  V pixel;   ///< its index in the block
  PathError<V> error;
  std::size_t light_set = 0;  ///< of places on soft lights
};

/// The order that puts the lanes of `mask`, at least one, first. Made once for all values to be
/// stored: Highway's Compress copies a table at each call, and CompressStore is slow on some
/// processors.
template <class D, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE auto compressing_order(D d, M mask) {
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  HWY_ALIGN hwy::MakeSigned<T> order[most_lanes] = {};
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < most_lanes; ++lane) {
    order[count] = static_cast<hwy::MakeSigned<T>>(lane);
    count += bytes[lane / 8] >> (lane % 8) & 1U;
  }
  return hn::SetTableIndices(d, order);
}

/// The queue of rays to be followed, those that still matter side by side.
template <typename T>
class FollowedRays {
 public:
  int count = 0;
  std::size_t light_set = 0;  ///< of all

  /// Adds the lanes of `mask`, at least one.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE void add(D d, const Packet<V>& rays, M mask) {
    const auto first_of_mask = compressing_order(d, mask);
    const auto keep = [&](V values, T* column) HWY_ATTR {
      hn::StoreU(hn::TableLookupLanes(values, first_of_mask), d, column + count);
    };
    const V values[] = {
        rays.direction.x,   rays.direction.y,  rays.direction.z,   rays.from.point.x,
        rays.from.point.y,  rays.from.point.z, rays.from.normal.x, rays.from.normal.y,
        rays.from.normal.z, rays.from.id,      rays.from.u,        rays.from.v,
        rays.weight,        rays.pixel,        rays.error.place,   rays.error.direction};
    for (std::size_t i = 0; i < column_count; ++i) keep(values[i], columns_[i]);
    count += static_cast<int>(count_true(d, mask));
  }

  /// The rays from the i-th on. Lanes that are not `active` hold zeros: kept from becoming indices
  /// or NaN traps.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE Packet<V> packet(D d, int i, M active) const {
    const auto at = [&](std::size_t column) HWY_ATTR {
      return hn::IfThenElseZero(active, hn::LoadU(d, columns_[column] + i));
    };
    PathError<V> error = eye_error(d);
    if constexpr (may_be_inexact<T>) error = {at(14), at(15)};
    return {{{at(3), at(4), at(5)}, {at(6), at(7), at(8)}, at(9), at(10), at(11)},
            {at(0), at(1), at(2)},
            at(12),
            at(13),
            error,
            light_set};
  }

 private:
  static constexpr std::size_t column_count = may_be_inexact<T> ? 16 : 14;
  alignas(64) T columns_[column_count][block_pixels + 64];
};

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

/// The colours that a packet sees, and in `doubt`, if somebody wants it, by how much they may make
/// their pixels' be off; the rays that mirrors send on are kept in `followed`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_packet(D d, const PacketScene<T>& scene, const Packet<V>& packet,
                              const Hit<V>& hit, M active, bool follows, FollowedRays<T>& followed,
                              V* doubt) {
  const V zero = hn::Zero(d);
  const M is_hit = hn::And(active, hn::Ge(hit.id, zero));
  const V3<V> background = broadcast(d, scene.background);
  if (hn::AllFalse(d, is_hit)) return background;
  const Surface<D> surface = surface_at(d, scene, packet.from, packet.direction, hit, is_hit);
  const V3<V> colour = select(is_hit,
                              shade(d, scene, surface, negate(packet.direction), is_hit,
                                    packet.light_set, OpaqueSurfaces()),
                              background);
  V weight = zero;
  M mirrors = hn::Lt(zero, zero);
  if (follows) {
    weight = hn::Mul(packet.weight, surface.material(d, &MaterialRow<T>::reflectivity));
    mirrors = hn::And(is_hit, hn::Gt(weight, zero));
  }
  const bool goes_on = !hn::AllFalse(d, mirrors);
  PathError<V> error = packet.error;
  if constexpr (may_be_inexact<T>)
    if (scene.exact.scene && (goes_on || doubt != nullptr))
      error = note_errors(d, scene, surface, packet, hit.t, is_hit, mirrors, doubt);
  if (!goes_on || hn::AllFalse(d, mirrors)) return colour;
  const V3<V> direction = mirrored(d, scene, surface, packet.direction);
  followed.add(d, Packet<V>{surface.at, direction, weight, packet.pixel, error, 0}, mirrors);
  return colour;
}

/// Adds by how much a packet's colours may be off to their pixels' doubts.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void add_doubts(D d, V doubt, const Packet<V>& packet, M active,
                           SampleColours<T>& colours) {
  alignas(64) T pixels[hn::MaxLanes(D())];
  alignas(64) T doubts[hn::MaxLanes(D())];
  hn::Store(packet.pixel, d, pixels);
  hn::Store(doubt, d, doubts);
  const std::size_t count = count_true(d, active);
  for (std::size_t lane = 0; lane < count; ++lane)
    colours.doubt[static_cast<std::size_t>(pixels[lane])] += doubts[lane];
}

/// Adds the colours that a packet's rays see to their pixels, and by how much they may be off.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void add_to_pixels(D d, const PacketScene<T>& scene, const V3<V>& colour, V doubt,
                              const Packet<V>& packet, M active, SampleColours<T>& colours) {
  if constexpr (may_be_inexact<T>)
    if (scene.exact.scene) add_doubts(d, doubt, packet, active, colours);
  alignas(64) T pixels[hn::MaxLanes(D())];
  alignas(64) T weighted[3][hn::MaxLanes(D())];
  hn::Store(packet.pixel, d, pixels);
  hn::Store(hn::Mul(colour.x, packet.weight), d, weighted[0]);
  hn::Store(hn::Mul(colour.y, packet.weight), d, weighted[1]);
  hn::Store(hn::Mul(colour.z, packet.weight), d, weighted[2]);
  const std::size_t count = count_true(d, active);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto pixel = static_cast<std::size_t>(pixels[lane]);
    colours.red[pixel] += weighted[0][lane];
    colours.green[pixel] += weighted[1][lane];
    colours.blue[pixel] += weighted[2][lane];
  }
}

/// One step of followed rays: adds what they see, and keeps those that follow them.
template <typename T>
void trace_step(const PacketScene<T>& scene, const FollowedRays<T>& rays, bool follows,
                FollowedRays<T>& next, SampleColours<T>& colours) {
  const hn::ScalableTag<T> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V far_away = hn::Set(d, std::numeric_limits<T>::max());
  next.count = 0;
  for (int i = 0; i < rays.count; i += lanes) {
    const auto active = hn::FirstN(d, static_cast<std::size_t>(rays.count - i));
    const Packet<V> packet = rays.packet(d, i, active);
    const Hit<V> hit = find_followed(d, scene, packet.from, packet.direction, far_away, active);
    V doubt = hn::Zero(d);
    const V3<V> colour = shade_packet(d, scene, packet, hit, active, follows, next, &doubt);
    add_to_pixels(d, scene, colour, doubt, packet, active, colours);
  }
}

/// Follows rays to the scene's depth and adds what they see. Leaves rubbish in `rays`.
template <typename T>
void trace_followed(const PacketScene<T>& scene, FollowedRays<T>& rays, SampleColours<T>& colours) {
  FollowedRays<T> others;
  others.light_set = rays.light_set;
  FollowedRays<T>* now = &rays;
  FollowedRays<T>* next = &others;
  for (int depth = 1; now->count > 0; ++depth) {
    trace_step(scene, *now, depth < scene.max_depth, *next, colours);
    std::swap(now, next);
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

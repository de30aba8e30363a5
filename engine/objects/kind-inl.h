// What packets of rays need of a kind of object, a concept for each piece: one that is listed in
// objects-inl.h and lacks a piece does not compile. Asked for packets of floats; those of doubles
// are the same templates. All kinds come before the concepts, which find what stands there.

#include <concepts>
#include <cstdint>

#include "engine/lights/packet_light.h"
#include "engine/objects/geometry.h"
#include "engine/objects/packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// A packet of floats.
struct FloatPacket {
  using D = hn::ScalableTag<float>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  RayOrigin<V> origin;
  V3<V> direction;
  M active;
};

/// Lanes from which it hides a light.
template <class Kind>
concept HasOcclusion = requires(FloatPacket::D d, const Geometry<Kind, float>& geometry,
                                const PacketLight<float>& light,
                                const ShadowRays<FloatPacket::V>& rays, FloatPacket::M lit) {
  { occluded_by(d, geometry, light, rays, lit) } -> std::same_as<FloatPacket::M>;
};

/// The packet against one item, which all lanes try.
template <class Kind>
concept HasItemIntersection = requires(FloatPacket::D d, const FloatPacket& packet,
                                       const Geometry<Kind, float>& geometry,
                                       Hit<FloatPacket::V>& hit) {
  intersect_item(d, geometry, geometry.items[0], packet.origin, packet.direction, packet.active,
                 hit);
};

/// Rays from the eye against what a screen bin names.
template <class Kind>
concept HasCandidates = requires(FloatPacket::D d, const PrimitiveRows<float>& rows,
                                 const Geometry<Kind, float>& geometry, std::uint32_t name,
                                 const FloatPacket& packet, Hit<FloatPacket::V>& hit) {
  intersect_candidate(d, rows, geometry, name, packet.direction, hit);
  prefetch_candidate(rows, geometry, name);
};

/// Against a leaf of a tree: lanes_of(block, get) are its primitives, one to a lane or one in all
/// of them, `get` taking a column to a vector; the lanes that meet theirs do so at t.
template <class Kind>
concept HasLeaves = requires(FloatPacket::D d,
                             const typename Geometry<Kind, float>::Layout::Block& block,
                             FloatPacket::V get(const BlockColumn<float>&),
                             const TreeRays<FloatPacket::V>& rays, FloatPacket::M active,
                             FloatPacket::V& t) {
  { intersect(d, lanes_of(block, get), rays, active, t) } -> std::same_as<FloatPacket::M>;
};

/// Of a kind that finds its own parts, instead of these: rays from the eye, or followed ones.
template <class Kind>
concept HasOwnIntersection = requires(FloatPacket::D d, const FloatPacket& packet,
                                      const Geometry<Kind, float>& geometry,
                                      Hit<FloatPacket::V>& hit) {
  intersect_own<true>(d, geometry, packet.origin, packet.direction, packet.active, hit);
  intersect_own<false>(d, geometry, packet.origin, packet.direction, packet.active, hit);
};

template <class Kind>
concept HasItsIntersection = (Kind::search == Search::unbounded && HasItemIntersection<Kind>) ||
                             (Kind::search == Search::bounded && HasItemIntersection<Kind> &&
                              HasCandidates<Kind> && HasLeaves<Kind>) ||
                             (Kind::search == Search::own && HasOwnIntersection<Kind>);

template <class Kind>
concept PacketKind = HasOcclusion<Kind> && HasItsIntersection<Kind>;

static_assert(each_satisfies<ObjectKinds>([]<PacketKind Kind>(std::type_identity<Kind>) {}));

// What a kind may have.

/// Whether a cone from the eye may meet what a screen bin names; else a pixel's candidates are all
/// of its subtile's.
template <class Kind>
concept HasConeTest = requires(const PrimitiveRows<float>& rows,
                               const Geometry<Kind, float>& geometry, std::uint32_t name,
                               const Triple<float>& axis, float spread) {
  { may_intersect(rows, geometry, name, axis, spread) } -> std::same_as<bool>;
};

/// Sets the normals of the lanes of `own` that hit one of the kind; else a hit's row tells them.
template <class Kind>
concept HasOwnNormals = requires(FloatPacket::D d, const PrimitiveRows<float>& rows,
                                 const Geometry<Kind, float>& geometry, const FloatPacket& packet,
                                 RayOrigin<FloatPacket::V>& at) {
  own_normals(d, rows, geometry, packet.direction, packet.active, at);
};

/// Sets the distances at which the rays of the lanes of `own` meet those of the kind that they are
/// known to hit, and the normals there if own_normals() does not; else a hit's row tells them.
template <class Kind>
concept HasOwnDistances = requires(FloatPacket::D d, const PrimitiveRows<float>& rows,
                                   const Geometry<Kind, float>& geometry, const FloatPacket& packet,
                                   Hit<FloatPacket::V>& hit) {
  own_distances(d, rows, geometry, packet.origin, packet.direction, packet.active, hit);
};

/// Tells on which side rays have hit those of the kind, where rows do not.
template <class Kind>
concept HasOwnSides = requires(const PrimitiveRows<float>& rows,
                               const Geometry<Kind, float>& geometry, const FloatPacket& packet,
                               RayOrigin<FloatPacket::V>& at, FloatPacket::V& side) {
  own_sides(FloatPacket::D(), rows, geometry, packet.direction, packet.active, packet.active, at,
            side);
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

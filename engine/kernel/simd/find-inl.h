// What packets hit, and what hides lights from them: which finder takes which rays to each kind of
// object, as the plan has chosen.

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Calls visit(geometry) for the kinds of objects that there are.
template <std::size_t kind = 0, typename T, class Visit>
HWY_INLINE void for_each_geometry(const Geometries<T>& geometries, const Visit& visit) {
  if constexpr (kind < ObjectKinds::count) {
    const auto& geometry = std::get<kind>(geometries.kinds);
    if (geometry.count > 0) visit(geometry);
    for_each_geometry<kind + 1>(geometries, visit);
  }
}
template <typename T, class Visit>
HWY_INLINE void for_each_geometry(const PacketScene<T>& scene, const Visit& visit) {
  for_each_geometry(scene.geometry, visit);
}

/// Rays from the eye against one kind: near to far of the candidates, until the next one is farther
/// than all that is hit already. `candidates` are those of what the rays go through.
template <class D, class Kind, class Candidates, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_from_eye(D d, const PacketScene<T>& scene,
                                   const Geometry<Kind, T>& geometry, Candidates& candidates,
                                   const RayOrigin<V>& eye, const V3<V>& direction, M active,
                                   Hit<V>& hit) {
  if constexpr (Kind::search == Search::own) {
    if (candidates.template may_contain<Kind>())
      intersect_own<false>(d, geometry, eye, direction, active, hit);
  } else if constexpr (Kind::search == Search::unbounded) {
    for (const auto& item : geometry.items)
      intersect_item(d, geometry, item, eye, direction, active, hit);
  } else if (geometry.finder(RayKind::from_eye) == Finder::screen_bins) {
    const auto sees = [&](float distance)
                          HWY_ATTR { return sees_as_far_as(d, distance, hit, active); };
    candidates.template for_each<Kind>(sees, [&](std::uint32_t primitive) HWY_ATTR {
      intersect_candidate(d, scene.primitives, geometry, primitive, direction, hit);
    });
  } else {
    intersect_tree(d, geometry.tree, eye, direction, active, hit);
  }
}

/// What rays look for.
struct Everything {};

/// What lets some light through, or what lets none through.
struct ChosenPart {
  bool transmits;
};

template <typename T, class Visit>
HWY_INLINE void for_each_geometry(const PacketScene<T>& scene, Everything, const Visit& visit) {
  for_each_geometry(scene.geometry, visit);
}
template <std::size_t kind = 0, typename T, class Visit>
HWY_INLINE void for_each_geometry(const PacketScene<T>& scene, ChosenPart part,
                                  const Visit& visit) {
  if constexpr (kind < ObjectKinds::count) {
    const auto& whole = std::get<kind>(scene.geometry.kinds);
    const Geometries<T>& of_both = part.transmits ? scene.transmitting : scene.opaque;
    const auto& geometry = whole.is_split ? std::get<kind>(of_both.kinds) : whole;
    if (geometry.count > 0 && geometry.transmits == part.transmits) visit(geometry);
    for_each_geometry<kind + 1>(scene, part, visit);
  }
}

/// Rays that follow others against one kind. Of what lets nothing through none comes out.
template <class D, class Kind, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_followed(D d, const Geometry<Kind, T>& geometry, const Origin& from,
                                   const V3<V>& direction, M active, Hit<V>& hit) {
  if constexpr (may_be_inside<Origin>)
    if (!geometry.transmits)
      return intersect_followed<D, Kind, RayOrigin<V>>(d, geometry, from, direction, active, hit);
  if constexpr (Kind::search == Search::own) {
    intersect_own<true>(d, geometry, from, direction, active, hit);
  } else {
    if constexpr (Kind::search == Search::bounded)
      if (geometry.finder(RayKind::followed) == Finder::tree)
        return intersect_tree(d, geometry.tree, from, direction, active, hit);
    for (const auto& item : geometry.items)
      intersect_item(d, geometry, item, from, direction, active, hit);
  }
}

/// What rays that follow others meet nearer than t_max, of the `parts` that are chosen.
template <class D, class Origin, class Parts = Everything, class V = hn::Vec<D>,
          class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Hit<V> find_followed(D d, const PacketScene<T>& scene, const Origin& from,
                                const V3<V>& direction, V t_max, M active,
                                const Parts& parts = {}) {
  const V none = hn::Set(d, T(-1));
  Hit<V> hit{t_max, none, none, none};
  for_each_geometry(scene, parts, [&](const auto& geometry) RAYTRACER_INLINE_ATTR {
    intersect_followed(d, geometry, from, direction, active, hit);
  });
  return hit;
}

/// Lanes of `lit` from which something of one kind stands before the light.
template <class D, class Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_kind(D d, const Geometry<Kind, T>& geometry, const PacketLight<T>& light,
                              const ShadowRays<V>& rays, M lit) {
  if constexpr (Kind::search == Search::bounded)
    if (geometry.finder(ray_kind_of(light)) == Finder::tree)
      return occluded_in_tree(d, geometry.tree, rays.from, rays.towards,
                              hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>)), lit);
  return occluded_by(d, geometry, light, rays, lit);
}

/// The same before the end of an axis that each lane looks to. What sweeps find is told elsewhere.
template <class D, class Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_kind(D d, const Geometry<Kind, T>& geometry, const LightAxis<D>& axis,
                              const ShadowRays<V>& rays, M lit) {
  constexpr bool knows_axes = requires { occluded_by(d, geometry, axis, rays, lit); };
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  if (geometry.finder(RayKind::to_soft_light) == Finder::light_sweep) return dark;
  if constexpr (knows_axes)
    if (geometry.finder(RayKind::to_soft_light) != Finder::tree)
      return occluded_by(d, geometry, axis, rays, lit);
  const M there = hn::AndNot(axis.opposite_lanes, lit);
  if (!hn::AllFalse(d, there)) dark = occluded_by_kind(d, geometry, axis.light, rays, there);
  const M opposite = hn::And(axis.opposite_lanes, lit);
  if (!hn::AllFalse(d, opposite))
    dark = hn::Or(dark, occluded_by_kind(d, geometry, *axis.opposite, rays, opposite));
  return dark;
}

/// Lanes of `lit` from which something of one kind stands nearer than `distance`.
template <class D, class Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M stands_nearer(D d, const Geometry<Kind, T>& geometry, const RayOrigin<V>& from,
                           const V3<V>& towards, V distance, M lit) {
  if constexpr (Kind::search == Search::bounded)
    if (geometry.finder(RayKind::followed) == Finder::tree)
      return occluded_in_tree(d, geometry.tree, from, towards, distance, lit);
  const V none = hn::Set(d, T(-1));
  Hit<V> hit{distance, none, none, none};
  intersect_followed(d, geometry, from, towards, lit, hit);
  return hn::And(lit, hn::Ge(hit.id, hn::Zero(d)));
}

/// Lanes of `lit` from which something stands on the way to a place on a soft light, by what finds
/// followed rays; of the `parts` that are chosen.
template <class D, class Parts = Everything, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M occluded_followed(D d, const PacketScene<T>& scene, const ShadowRays<V>& rays, M lit,
                               const Parts& parts = {}) {
  const V distance = hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>));
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  for_each_geometry(scene, parts, [&](const auto& geometry) RAYTRACER_INLINE_ATTR {
    dark = hn::Or(
        dark, stands_nearer(d, geometry, rays.from, rays.towards, distance, hn::AndNot(dark, lit)));
  });
  return dark;
}

/// What may stand between a packet's points and a light, of each kind that a tree finds.
template <typename T>
class LightCandidates {
 public:
  /// None if nobody asks for them.
  HWY_NOINLINE LightCandidates(const PacketScene<T>& scene, const Shaft<T>& shaft,
                               bool is_searched) {
    if (!is_searched) return;
    for_each_geometry(scene,
                      [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                        if constexpr (Kind::search == Search::bounded)
                          if (geometry.finder(RayKind::followed) == Finder::tree)
                            kinds_[kind_index<Kind>].find(EightTag<T>(), geometry.tree, shaft);
                      });
  }

  /// As occluded_followed(), of rays inside the shaft.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE M occluded(D d, const PacketScene<T>& scene, const ShadowRays<V>& rays, M lit) const {
    const V distance = hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>));
    M dark = hn::AndNot(lit, lit);
    for_each_geometry(
        scene, [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
          const M rest = hn::AndNot(dark, lit);
          if constexpr (Kind::search == Search::bounded) {
            const ShaftCandidates& candidates = kinds_[kind_index<Kind>];
            if (geometry.finder(RayKind::followed) == Finder::tree && candidates.is_complete) {
              dark = hn::Or(dark, occluded_by_candidates(d, geometry.tree, candidates, rays.from,
                                                         rays.towards, distance, rest));
              return;
            }
          }
          dark = hn::Or(dark, stands_nearer(d, geometry, rays.from, rays.towards, distance, rest));
        });
    return dark;
  }

 private:
  std::array<ShaftCandidates, ObjectKinds::count> kinds_;
};

/// Lanes of `lit` from which something of the `parts` that are chosen stands before a light, or
/// the end of an axis.
template <class D, class Light, class Parts = Everything, class V = hn::Vec<D>,
          class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded(D d, const PacketScene<T>& scene, const Light& light,
                      const ShadowRays<V>& rays, M lit, const Parts& parts = {}) {
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  for_each_geometry(scene, parts, [&](const auto& geometry) RAYTRACER_INLINE_ATTR {
    dark = hn::Or(dark, occluded_by_kind(d, geometry, light, rays, hn::AndNot(dark, lit)));
  });
  return dark;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Light that comes through surfaces, and on which side of what has an inside a point is.

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// On which side a ray of direction `direction` has hit each surface: 1 inside, 0 outside, -1 of
/// what has none. Normals are turned to that side. Only the lanes of `within` may come from inside
/// of a solid.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V tell_sides(D d, const PacketScene<T>& scene, const V3<V>& direction, M is_hit,
                        M within, Surface<D>& surface) {
  using Row = PrimitiveRow<T>;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  RayOrigin<V>& at = surface.at;
  const Rows<D, Row> primitive(d, scene.primitives.data(), at.id, is_hit);
  const V curvature = primitive(d, &Row::curvature);
  const M is_round = hn::And(is_hit, hn::Gt(curvature, zero));
  const M leaves = hn::And(hn::And(is_round, within), hn::Gt(dot(at.normal, direction), zero));
  V side = hn::IfThenElseZero(leaves, one);
  at.normal = select(leaves, negate(at.normal), at.normal);
  surface.normal = select(leaves, at.normal, surface.normal);
  const M is_flat = hn::And(is_hit, hn::Eq(curvature, zero));
  // `place` is the opposite of the normal.
  const M is_back = hn::Lt(dot(primitive(d, &Row::place), direction), zero);
  side = hn::IfThenElse(is_flat, hn::IfThenElseZero(is_back, one), side);
  const M own = hn::And(is_hit, hn::Lt(curvature, zero));
  if (!scene.has_own_normals || hn::AllFalse(d, own)) return side;
  for_each_geometry(scene,
                    [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                      if constexpr (HasOwnSides<Kind>)
                        own_sides(d, scene.primitives, geometry, direction, own, within, at, side);
                    });
  surface.normal = select(own, at.normal, surface.normal);
  return side;
}

/// The glass of what has been hit.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Rows<D, GlassRow<T>> glass_of(D d, const PacketScene<T>& scene, V id, M is_hit) {
  using Row = PrimitiveRow<T>;
  const Rows<D, Row> primitive(d, scene.primitives.data(), id, is_hit);
  return primitive.followed(d, &Row::material, scene.materials.glass.data(), is_hit);
}

/// Of how many solids rays that have hit surfaces, on that `side`, are inside once they have passed
/// them.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V depth_beyond(D d, const PacketScene<T>& scene, V id, V side, M is_hit, V depth) {
  using Row = PrimitiveRow<T>;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const Rows<D, Row> primitive(d, scene.primitives.data(), id, is_hit);
  const M is_solid = hn::And(hn::Ne(primitive(d, &Row::curvature), zero), hn::Ge(side, zero));
  const V step = hn::IfThenElse(hn::Gt(side, zero), hn::Neg(one), one);
  return hn::Max(hn::Add(depth, hn::IfThenElseZero(is_solid, step)), zero);
}

inline constexpr ChosenPart opaque_part{.transmits = false};
inline constexpr ChosenPart transmitting_part{.transmits = true};

/// What rays meet nearer than t_max that are inside of `depth` solids.
template <class D, class Parts = Everything, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE Hit<V> find_within(D d, const PacketScene<T>& scene, const RayOrigin<V>& from,
                                const V3<V>& direction, V t_max, V depth, M active,
                                const Parts& parts = {}) {
  if (hn::AllFalse(d, hn::And(active, hn::Gt(depth, hn::Zero(d)))))
    return find_followed(d, scene, from, direction, t_max, active, parts);
  return find_followed(d, scene, InnerOrigin<V>{from}, direction, t_max, active, parts);
}

/// Lanes of `lit` from which something stands before the light.
template <class D, class Light, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_by_chosen(D d, const PacketScene<T>& scene, const Light& light,
                                  const ShadowRays<V>& rays, M lit, ChosenPart part) {
  return occluded(d, scene, light, rays, lit, part);
}

/// Surfaces in one place that light is followed through: one that has met so many without getting
/// on goes to and fro between some that rounding cannot tell apart.
inline constexpr int most_in_one_place = 16;

/// How much of the light that starts out from a light arrives at points before which nothing stands
/// that lets none through: the product of the transparencies on the straight way. `depth` is of how
/// many solids the points are inside.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE V transmitted_share(D d, const PacketScene<T>& scene, const ShadowRays<V>& rays,
                                 V depth, M active) {
  const V zero = hn::Zero(d);
  V share = hn::Set(d, T(1));
  V left = hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>));
  RayOrigin<V> from = rays.from;
  V met = zero;  // since it has got on by more than rounding
  while (true) {
    const Hit<V> hit =
        find_within(d, scene, from, rays.towards, left, depth, active, transmitting_part);
    active = hn::And(active, hn::Ge(hit.id, zero));
    if (hn::AllFalse(d, active)) return share;
    Surface<D> surface = surface_at(d, scene, from, rays.towards, hit, active);
    const V side = tell_sides(d, scene, rays.towards, active, hn::Gt(depth, zero), surface);
    const V transparency = glass_of(d, scene, surface.at.id, active)(d, &GlassRow<T>::transparency);
    share = hn::IfThenElse(active, hn::Mul(share, transparency), share);
    const V3<V>& point = surface.at.point;
    const V size = hn::Add(hn::Abs(point.x), hn::Add(hn::Abs(point.y), hn::Abs(point.z)));
    const V rounding = hn::Mul(size, hn::Set(d, 8 * std::numeric_limits<T>::epsilon()));
    met = hn::IfThenElseZero(hn::Le(hit.t, rounding), hn::Add(met, hn::Set(d, T(1))));
    active = hn::And(active, hn::Gt(share, zero));
    active = hn::And(active, hn::Lt(met, hn::Set(d, T(most_in_one_place))));
    if (hn::AllFalse(d, active)) return share;
    left = hn::Sub(left, hit.t);
    depth = depth_beyond(d, scene, surface.at.id, side, active, depth);
    from = surface.at;
    from.normal = negate(from.normal);
  }
}

/// What comes through everything that stands before a light, for shade().
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
class LightThroughSurfaces {
 public:
  static constexpr bool hides_all = false;

  HWY_INLINE LightThroughSurfaces(D d, V depth) : depth_(depth), share_(hn::Set(d, T(1))) {}

  template <class Light>
  HWY_INLINE M reached(D d, const PacketScene<T>& scene, const Light& light,
                       const ShadowRays<V>& rays, M lit) {
    share_ = hn::Set(d, T(1));
    lit = hn::AndNot(occluded_by_chosen(d, scene, light, rays, lit, opaque_part), lit);
    const M inside = hn::And(lit, hn::Gt(depth_, hn::Zero(d)));
    const M outside = hn::AndNot(inside, lit);
    M doubtful = inside;
    if (!hn::AllFalse(d, outside))
      doubtful =
          hn::Or(inside, occluded_by_chosen(d, scene, light, rays, outside, transmitting_part));
    if (hn::AllFalse(d, doubtful)) return lit;
    const V through = transmitted_share(d, scene, rays, depth_, doubtful);
    share_ = hn::IfThenElse(doubtful, through, share_);
    return hn::And(lit, hn::Gt(share_, hn::Zero(d)));
  }
  HWY_INLINE V share_along(D d, const PacketScene<T>& scene, const ShadowRays<V>& rays,
                           M lit) const {
    const M clear = hn::AndNot(occluded_followed(d, scene, rays, lit, opaque_part), lit);
    if (hn::AllFalse(d, clear)) return hn::Zero(d);
    return hn::IfThenElseZero(clear, transmitted_share(d, scene, rays, depth_, clear));
  }
  HWY_INLINE V weakened(V share) const { return hn::Mul(share, share_); }

 private:
  V depth_;
  V share_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Packets against triangles.

#include <hwy/cache_control.h>

#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/lights/packet_light.h"
#include "engine/objects/geometry.h"
#include "engine/objects/triangle/packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Triangles, one for each lane's ray.
template <class V>
struct Triangles {
  V3<V> a;
  V3<V> b;
  V3<V> c;
  V3<V> normal;
  V height;
  V id;
};

/// Lanes whose rays pass through their triangle, as intersect() in objects/triangle/reference.cpp
/// decides it. The products are not fused: that could make their difference's sign wrong.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M passes_through(D d, const Triangles<V>& triangles, const V3<V>& origin,
                            const BasisPacket<V>& plane) {
  const V3<V> a = sub(triangles.a, origin);
  const V3<V> b = sub(triangles.b, origin);
  const V3<V> c = sub(triangles.c, origin);
  const V a_u = dot(plane.u, a);
  const V a_v = dot(plane.v, a);
  const V b_u = dot(plane.u, b);
  const V b_v = dot(plane.v, b);
  const V c_u = dot(plane.u, c);
  const V c_v = dot(plane.v, c);
  const V ab = hn::Sub(hn::Mul(a_u, b_v), hn::Mul(a_v, b_u));
  const V bc = hn::Sub(hn::Mul(b_u, c_v), hn::Mul(b_v, c_u));
  const V ca = hn::Sub(hn::Mul(c_u, a_v), hn::Mul(c_v, a_u));
  const V least = hn::Min(hn::Min(ab, bc), ca);
  const V most = hn::Max(hn::Max(ab, bc), ca);
  const V zero = hn::Zero(d);
  return hn::Or(hn::Ge(least, zero), hn::Le(most, zero));
}

/// Lanes whose triangle does not lie wholly on or under the tangent plane that the ray leaves. What
/// does cannot be met by it: that settles the triangle itself and its coplanar neighbours by their
/// exact corners, not by the rounded point.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M rises_above(D d, const Triangles<V>& triangles, const RayOrigin<V>& from) {
  const V reach =
      hn::Add(hn::Max(hn::Abs(from.point.x), hn::Abs(from.point.y)), hn::Abs(from.point.z));
  M above = hn::Lt(from.id, hn::Zero(d));  // nothing is under the eye
  for (const V3<V>* corner : {&triangles.a, &triangles.b, &triangles.c}) {
    const V size = hn::Add(hn::Add(hn::Abs(corner->x), hn::Abs(corner->y)), hn::Abs(corner->z));
    const V noise = hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(size, reach));
    above = hn::Or(above, hn::Gt(dot(from.normal, sub(*corner, from.point)), noise));
  }
  return above;
}

/// Distances to triangles.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Triangles<V>& triangles, const RayOrigin<V>& from,
                       const V3<V>& direction, const BasisPacket<V>& plane, M active, V& t) {
  M hit = hn::And(active, passes_through(d, triangles, from.point, plane));
  t = hn::Zero(d);
  if (hn::AllFalse(d, hit)) return hit;
  hit = hn::And(hit, intersect_plane(d, triangles.normal, triangles.height, triangles.id, from,
                                     direction, t));
  return hn::And(hit, rises_above(d, triangles, from));
}

/// Those of a block: `get` takes a column to a vector.
template <typename T, class Get>
HWY_INLINE auto lanes_of(const TriangleBlock<T>& block, Get get) {
  const auto corner = [&](std::size_t i) HWY_ATTR {
    return V3<decltype(get(block.id))>{get(block.corners[i]), get(block.corners[i + 1]),
                                       get(block.corners[i + 2])};
  };
  return Triangles<decltype(get(block.id))>{
      corner(0),         corner(3),
      corner(6),         {get(block.normal[0]), get(block.normal[1]), get(block.normal[2])},
      get(block.height), get(block.id)};
}
/// What finders/tree-inl.h asks for: lanes whose rays meet their triangles, at t.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Triangles<V>& triangles, const TreeRays<V, Origin>& rays,
                       M active, V& t) {
  return intersect(d, triangles, rays.from, rays.direction, rays.basis, active, t);
}

/// Rays from the eye against triangle `index`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_candidate(D d, const PrimitiveRows<T>&,
                                    const Geometry<TriangleKind, T>& triangles, std::uint32_t index,
                                    const V3<V>& direction, Hit<V>& hit) {
  // Four roundings of half an epsilon: of the normal, and three in the dot product.
  const V outside = hn::Set(d, -2 * std::numeric_limits<T>::epsilon());
  const TriangleCone<T>& cone = triangles.eye.cones[index];
  const V least =
      hn::Min(hn::Min(dot(broadcast(d, cone[0]), direction), dot(broadcast(d, cone[1]), direction)),
              dot(broadcast(d, cone[2]), direction));
  const M inside = hn::Ge(least, outside);
  if (hn::AllFalse(d, inside)) return;
  const FlatItem<T>& plane = triangles.items[index].plane;
  const V t = hn::Div(hn::Set(d, plane.height), dot(broadcast(d, plane.normal), direction));
  const M ahead =
      hn::And(hn::Gt(t, hn::Zero(d)), hn::Lt(t, hn::Set(d, std::numeric_limits<T>::max())));
  const V id = hn::Set(d, plane.id);
  take(hit, is_nearer(hit, t, id, hn::And(inside, ahead)), t, id);
}

/// Asks the memory for what the function above reads.
template <typename T>
HWY_INLINE void prefetch_candidate(const PrimitiveRows<T>&,
                                   const Geometry<TriangleKind, T>& triangles,
                                   std::uint32_t index) {
  hwy::Prefetch(&triangles.eye.cones[index]);
  hwy::Prefetch(&triangles.items[index].plane);
}

/// A triangle in all lanes.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Triangles<V> in_all_lanes(D d, const TriangleItem<T>& triangle) {
  return {broadcast(d, triangle.corners[0]), broadcast(d, triangle.corners[1]),
          broadcast(d, triangle.corners[2]), broadcast(d, triangle.plane.normal),
          hn::Set(d, triangle.plane.height), hn::Set(d, triangle.plane.id)};
}

/// The packet against one triangle.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_item(D d, const Geometry<TriangleKind, T>&, const TriangleItem<T>& item,
                               const RayOrigin<V>& from, const V3<V>& direction, M active,
                               Hit<V>& hit) {
  const Triangles<V> triangles = in_all_lanes(d, item);
  V t;
  const M is_hit = intersect(d, triangles, from, direction, basis_across(d, direction), active, t);
  take(hit, is_nearer(hit, t, triangles.id, is_hit), t, triangles.id);
}

/// What a point's distance from a plane or a line through it may be off by, so that no light comes
/// between triangles at a corner that they share: five roundings, of the normal, of the offset and
/// of three in the dot product, each of half an epsilon of the point's coordinates. The point's own
/// rounding is the same for all triangles. A line takes four.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V distance_noise(D d, const V3<V>& point) {
  const V size = hn::Add(hn::Add(hn::Abs(point.x), hn::Abs(point.y)), hn::Abs(point.z));
  return hn::Mul(hn::Set(d, T(2.5) * std::numeric_limits<T>::epsilon()), size);
}

/// Whether a triangle stands before its distant light for lanes of `lit`, and for which; the points
/// are `at` these places on its plane.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE bool hides_distant_light(D d, const TriangleItem<T>& triangle,
                                    const TriangleOutline<T>& outline, const LightPlaces<V>& at,
                                    const ShadowRays<V>& rays, V noise, M lit, M& hidden) {
  const auto side = [&](std::size_t i) HWY_ATTR {
    return hn::MulAdd(
        hn::Set(d, outline.u_slopes[i]), at.u,
        hn::MulAdd(hn::Set(d, outline.v_slopes[i]), at.v, hn::Set(d, outline.offsets[i])));
  };
  const V least = hn::Min(hn::Min(side(0), side(1)), side(2));
  const M covers = hn::And(lit, hn::Ge(least, hn::Neg(noise)));
  if (hn::AllFalse(d, covers)) return false;
  V t;
  const M hit = hn::And(covers, intersect_plane(d, triangle.plane, rays.from, rays.towards, t));
  if (hn::AllFalse(d, hit)) return false;
  hidden = hn::And(hit, rises_above(d, in_all_lanes(d, triangle), rays.from));
  return !hn::AllFalse(d, hidden);
}

/// The same before a point light. A triangle's own plane is asked first: points on a surface are
/// beyond few of those of their neighbours.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE bool hides_point_light(D d, const TriangleItem<T>& triangle,
                                  const TriangleShadow<T>& shadow, const ShadowRays<V>& rays,
                                  V noise, M lit, M& hidden) {
  const V3<V>& point = rays.from.point;
  const auto along = [&](std::size_t i)
                         HWY_ATTR { return dot(broadcast(d, shadow.normals[i]), point); };
  const V height = hn::Set(d, shadow.offsets[3]);
  const V at = along(3);
  const V on_plane = hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(hn::Abs(height), hn::Abs(at)));
  const M beyond = hn::And(lit, hn::Gt(hn::Sub(at, height), on_plane));
  if (hn::AllFalse(d, beyond)) return false;
  const auto side = [&](std::size_t i)
                        HWY_ATTR { return hn::Sub(along(i), hn::Set(d, shadow.offsets[i])); };
  const V least = hn::Min(hn::Min(side(0), side(1)), side(2));
  const M hit = hn::And(beyond, hn::Ge(least, hn::Neg(noise)));
  if (hn::AllFalse(d, hit)) return false;
  const M other = hn::Ne(rays.from.id, hn::Set(d, triangle.plane.id));
  hidden = hn::And(hn::And(hit, other), rises_above(d, in_all_lanes(d, triangle), rays.from));
  return !hn::AllFalse(d, hidden);
}

/// Lanes of `lit` from which a triangle stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_by(D d, const Geometry<TriangleKind, T>& triangles,
                           const PacketLight<T>& light, const ShadowRays<V>& rays, M lit) {
  const TriangleLightView<T>& view = triangles.lights[light.index];
  const V noise = distance_noise(d, rays.from.point);
  if (light.rays == LightRays::parallel) {
    const LightPlaces<V> at = places_on(d, view.grid.plane, rays.from.point);
    const auto hides = [&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
      return hides_distant_light(d, triangles.items[i], view.outlines[i], at, rays, noise, rest,
                                 hidden);
    };
    if (triangles.finder(ray_kind_of(light)) == Finder::one_by_one)
      return occluded_by_items(d, triangles.items.size(), lit, hides);
    return occluded_by_listed(d, view.grid, at, lit, hides);
  }
  const auto hides = [&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
    return hides_point_light(d, triangles.items[i], view.shadows[i], rays, noise, rest, hidden);
  };
  if (triangles.finder(RayKind::to_point_light) == Finder::one_by_one)
    return occluded_by_items(d, triangles.items.size(), lit, hides);
  return occluded_by_listed(d, view.lists, light.place, rays, lit, hides);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

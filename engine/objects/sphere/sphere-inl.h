// Packets against spheres.

#include <hwy/cache_control.h>

#include <cmath>
#include <cstdint>

#include "engine/lights/packet_light.h"
#include "engine/objects/geometry.h"
#include "engine/objects/sphere/packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Rays from the eye against the sphere of that number.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_candidate(D d, const PrimitiveRows<T>& rows,
                                    const Geometry<SphereKind, T>&, std::uint32_t number,
                                    const V3<V>& direction, Hit<V>& hit) {
  const V zero = hn::Zero(d);
  const PrimitiveRow<T>& sphere = rows[number];
  const V3<V> center = broadcast(d, sphere.place);
  const V b = dot(center, direction);
  const V3<V> l{hn::MulSub(direction.x, b, center.x), hn::MulSub(direction.y, b, center.y),
                hn::MulSub(direction.z, b, center.z)};
  // Of what is nearer than it is wide the horizon is where b^2 is the power.
  const V discriminant = HWY_UNLIKELY(sphere.eye_power < sphere.radius_square)
                             ? hn::MulSub(b, b, hn::Set(d, sphere.eye_power))
                             : hn::Sub(hn::Set(d, sphere.radius_square), dot(l, l));
  const M is_hit = hn::And(hn::Ge(discriminant, zero), hn::Gt(b, zero));
  // Also where no lane hits: a wrong guess of the processor, which of small spheres there would be
  // many, costs more than a division.
  const V t =
      hn::Div(hn::Set(d, sphere.eye_power), hn::Add(b, hn::Sqrt(hn::Max(discriminant, zero))));
  const V id = hn::Set(d, static_cast<T>(number));
  take(hit, is_nearer(hit, t, id, is_hit), t, id);
}

/// Asks the memory for what the function above reads.
template <typename T>
HWY_INLINE void prefetch_candidate(const PrimitiveRows<T>& rows, const Geometry<SphereKind, T>&,
                                   std::uint32_t number) {
  hwy::Prefetch(&rows[number]);
}

/// Whether a ray in the cone, which begins at the eye, may meet the sphere of that number.
/// Where it comes nearest to the centre it has gone no farther than that is away, so the axis
/// passes the centre at no more than the radius and `spread` times that distance.
template <typename T>
HWY_INLINE bool may_intersect(const PrimitiveRows<T>& rows, const Geometry<SphereKind, T>&,
                              std::uint32_t number, const Triple<T>& axis, T spread) {
  const PrimitiveRow<T>& sphere = rows[number];
  const Triple<T>& center = sphere.place;
  const T b = axis.x * center.x + axis.y * center.y + axis.z * center.z;
  const T lx = center.x - axis.x * b;
  const T ly = center.y - axis.y * b;
  const T lz = center.z - axis.z * b;
  const T distance2 = sphere.eye_power + sphere.radius_square;
  const T reach = std::sqrt(sphere.radius_square) + spread * std::sqrt(distance2);
  return !(lx * lx + ly * ly + lz * lz > reach * reach);
}

/// Spheres, one for each lane's ray.
template <class V>
struct Spheres {
  V3<V> center;
  V radius2;
  V id;
  V eye_power;
  bool has_wide;  ///< as is_wide() says
};

/// What rays have to do with their spheres.
template <class V>
struct SphereTerms {
  V3<V> from_center;  ///< where the rays start
  V b;                ///< from there to the point nearest to the centre
  V discriminant;
  V power;  ///< of the start: the square of a tangent; the product of both roots
  V size;   ///< of the numbers that the place is computed from where the ray meets the sphere
};

/// In the residual form (math/ray_sphere.h); where a ray starts nearer to the eye than a wide
/// sphere's radius, power and discriminant are what they are for the eye and what that place
/// differs: neither is a difference of squares of the radius then.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SphereTerms<V> sphere_terms(D, const Spheres<V>& spheres, const V3<V>& point,
                                       const V3<V>& direction) {
  const V3<V> f = sub(point, spheres.center);
  const V b = hn::Neg(dot(f, direction));
  const V3<V> l = mul_add(direction, b, f);
  const V radius = hn::Sqrt(spheres.radius2);
  SphereTerms<V> terms{f, b, hn::Sub(spheres.radius2, dot(l, l)),
                       hn::Sub(dot(f, f), spheres.radius2), radius};
  if (HWY_LIKELY(!spheres.has_wide)) return terms;
  const auto is_near = hn::Lt(dot(point, point), spheres.radius2);
  const V power = hn::Add(spheres.eye_power, dot(point, sub(f, spheres.center)));
  const auto is_flat = hn::And(is_near, hn::Lt(power, spheres.radius2));
  terms.power = hn::IfThenElse(is_near, power, terms.power);
  terms.discriminant = hn::IfThenElse(is_flat, hn::MulSub(b, b, power), terms.discriminant);
  terms.size = hn::IfThenElse(is_near, hn::Div(hn::Abs(spheres.eye_power), radius), radius);
  return terms;
}

/// Those of a block: `get` takes a column to a vector.
template <typename T, class Get>
HWY_INLINE auto lanes_of(const SphereBlock<T>& block, Get get) {
  return Spheres<decltype(get(block.x))>{{get(block.x), get(block.y), get(block.z)},
                                         get(block.radius2),
                                         get(block.id),
                                         get(block.eye_power),
                                         block.has_wide};
}
/// Lanes whose rays meet their spheres from outside, at t; no ray meets the sphere that it leaves.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Spheres<V>& spheres, const RayOrigin<V>& from,
                       const V3<V>& direction, M active, V& t) {
  const V zero = hn::Zero(d);
  t = zero;
  const auto [f, b, discriminant, power, size] = sphere_terms(d, spheres, from.point, direction);
  const M is_met = hn::And(hn::Ge(discriminant, zero), hn::Gt(b, zero));
  const M hit = hn::And(active, hn::And(hn::Ne(from.id, spheres.id), is_met));
  if (hn::AllFalse(d, hit)) return hit;
  t = hn::Div(hn::Max(power, zero), hn::Add(b, hn::Sqrt(hn::Max(discriminant, zero))));
  return hit;
}
/// The same of rays that may begin inside.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Spheres<V>& spheres, const InnerOrigin<V>& from,
                       const V3<V>& direction, M active, V& t) {
  const V zero = hn::Zero(d);
  const auto [f, b, discriminant, power, size] = sphere_terms(d, spheres, from.point, direction);
  const M is_left = hn::Eq(from.id, spheres.id);
  const M is_there =
      hn::Or(hn::AndNot(is_left, hn::Ge(discriminant, zero)), hn::And(is_left, hn::Gt(b, zero)));
  const V q = hn::Add(b, hn::CopySign(hn::Sqrt(hn::Max(discriminant, zero)), b));
  const V other = hn::Div(power, q);
  const M ahead = hn::Ge(b, zero);
  // From one side of the surface to the other: twice to the middle, however short that is.
  const V leave = hn::IfThenElse(is_left, hn::Add(b, b), hn::IfThenElse(ahead, q, other));
  const V noise = place_noise(d, from.point, size);
  const Chords<V, M> chords{is_there, hn::IfThenElse(ahead, other, q), leave, noise,
                            hn::Lt(zero, zero)};
  return hn::And(active, meet_solid(d, chords, from, spheres.id, dot(from.normal, f), t));
}
/// What finders/tree-inl.h asks for: lanes whose rays meet their spheres, at t.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Spheres<V>& spheres, const TreeRays<V, Origin>& rays, M active,
                       V& t) {
  return intersect(d, spheres, rays.from, rays.direction, active, t);
}

/// What finders/shaft-inl.h may ask for: lanes whose spheres the shaft may touch.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE hn::Mask<D> may_touch(D d, const Spheres<V>& spheres, const Shaft<T>& shaft) {
  return shaft.may_touch(d, spheres.center, hn::Sqrt(hn::Max(spheres.radius2, hn::Zero(d))));
}

/// The packet against one sphere.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_item(D d, const Geometry<SphereKind, T>&, const SphereItem<T>& sphere,
                               const Origin& from, const V3<V>& direction, M active, Hit<V>& hit) {
  const V id = hn::Set(d, sphere.id);
  V t;
  const M is_hit = intersect(d,
                             Spheres<V>{broadcast(d, sphere.center), hn::Set(d, sphere.radius2), id,
                                        hn::Set(d, sphere.eye_power), sphere.has_wide},
                             from, direction, active, t);
  if (hn::AllFalse(d, is_hit)) return;
  take(hit, is_nearer(hit, t, id, is_hit), t, id);
}

/// Lanes whose ray to a point light meets a SphereBall before it. Lanes hold points, spheres or
/// both. `towards` is a unit vector to the light, `path` the point's distance from it. No point is
/// inside a sphere.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M stands_before_light(D d, const V3<V>& center, V radius2, V nearest,
                                 const V3<V>& towards, V path) {
  const V zero = hn::Zero(d);
  const V b = hn::Neg(dot(center, towards));
  const V3<V> l = mul_add(towards, b, center);
  const M is_ahead = hn::Or(hn::Gt(b, zero), hn::Lt(nearest, zero));
  return hn::And(hn::And(is_ahead, hn::Lt(b, path)), hn::Ge(radius2, dot(l, l)));
}

/// The same before a light so far away that places seen from it would lose their digits: from the
/// points.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M stands_before_far_light(D d, const V3<V>& center, V radius2, const V3<V>& point,
                                     const V3<V>& towards, V path) {
  const V3<V> f = sub(center, point);
  const V b = dot(f, towards);
  const V3<V> l = mul_add(towards, hn::Neg(b), f);
  const M is_between = hn::And(hn::Gt(b, hn::Zero(d)), hn::Lt(b, path));
  return hn::And(is_between, hn::Ge(radius2, dot(l, l)));
}

/// Whether discs stand between points and their distant light: lanes hold points, discs or both.
template <typename T>
struct DiscTest {
  using Caster = SphereDisc<T>;
  enum Value : std::size_t { u, v, w, id, size };

  template <class D, class Get, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> operator()(D d, const Get& get, const V (&point)[size]) const {
    return hn::And(hn::Lt(point[w], get(Caster::column_w)),
                   stands_in_line(d, get, point[u], point[v], point[id]));
  }

  /// Whether discs other than `own_id` cover places.
  template <class D, class Get, class V = hn::Vec<D>>
  static HWY_INLINE hn::Mask<D> stands_in_line(D, const Get& get, V at_u, V at_v, V own_id) {
    const V du = hn::Sub(at_u, get(Caster::column_u));
    const V dv = hn::Sub(at_v, get(Caster::column_v));
    const V distance2 = hn::MulAdd(du, du, hn::Mul(dv, dv));
    return hn::And(hn::Ne(own_id, get(Caster::column_id)),
                   hn::Le(distance2, get(Caster::column_radius2)));
  }

  /// Whether this entry of a cell in order, and all behind it, are farther from the light.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> is_past(D d, const T* cell, std::size_t count, std::size_t i,
                                 const V (&point)[size]) const {
    if (count <= CasterGrid<Caster, T>::few) return hn::Lt(point[w], point[w]);
    return hn::Le(hn::Set(d, cell[Caster::column_w * count + i]), point[w]);
  }
};

/// The same of points each of which looks to one end of an axis.
template <typename T>
struct AxisDiscTest {
  using Caster = SphereDisc<T>;
  enum Value : std::size_t { u, v, w, id, side, size };  // side: 1 where the light is, -1 opposite
  const PlaneWindow<T>& window;                          ///< of all points
  T above;  ///< towards the light only what is beyond this hides a point
  T below;  ///< opposite, likewise

  template <class D, class Get, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> operator()(D d, const Get& get, const V (&point)[size]) const {
    const V ahead = hn::Mul(hn::Sub(get(Caster::column_w), point[w]), point[side]);
    return hn::And(hn::Gt(ahead, hn::Zero(d)),
                   DiscTest<T>::stands_in_line(d, get, point[u], point[v], point[id]));
  }
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> is_past(D d, const T* cell, std::size_t count, std::size_t i,
                                 const V (&point)[size]) const {
    if (count <= CasterGrid<Caster, T>::few) return hn::Lt(point[w], point[w]);
    return hn::And(hn::Gt(point[side], hn::Zero(d)),
                   hn::Le(hn::Set(d, cell[Caster::column_w * count + i]), point[w]));
  }
  /// Whether discs stand before any point of the window.
  template <class D, class Get, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> may_hide(D d, const Get& get) const {
    const auto beside = [&](std::size_t column, T middle, T half) HWY_ATTR {
      const V distance = hn::Abs(hn::Sub(get(column), hn::Set(d, middle)));
      return hn::Max(hn::Sub(distance, hn::Set(d, half)), hn::Zero(d));
    };
    const V du = beside(Caster::column_u, window.u, window.half_u);
    const V dv = beside(Caster::column_v, window.v, window.half_v);
    const V at_w = get(Caster::column_w);
    const auto is_ahead = hn::Or(hn::Gt(at_w, hn::Set(d, above)), hn::Lt(at_w, hn::Set(d, below)));
    return hn::And(is_ahead,
                   hn::Le(hn::MulAdd(du, du, hn::Mul(dv, dv)), get(Caster::column_radius2)));
  }
};

/// The same of balls and a point light.
template <typename T>
struct BallTest {
  using Caster = SphereBall<T>;
  enum Value : std::size_t { x, y, z, towards_x, towards_y, towards_z, path, id, size };
  bool is_far;

  template <class D, class Get, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> operator()(D d, const Get& get, const V (&point)[size]) const {
    const V3<V> center{get(Caster::column_x), get(Caster::column_y), get(Caster::column_z)};
    const V3<V> towards{point[towards_x], point[towards_y], point[towards_z]};
    const V radius2 = get(Caster::column_radius2);
    const auto is_hit =
        is_far ? stands_before_far_light(d, center, radius2, {point[x], point[y], point[z]},
                                         towards, point[path])
               : stands_before_light(d, center, radius2, get(Caster::column_nearest), towards,
                                     point[path]);
    return hn::And(is_hit, hn::Ne(get(Caster::column_id), point[id]));
  }

  /// Whether this entry of a cell, and all behind it, are beyond the point.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> is_past(D d, const T* cell, std::size_t count, std::size_t i,
                                 const V (&point)[size]) const {
    return hn::Gt(hn::Set(d, cell[Caster::column_nearest * count + i]), point[path]);
  }
};

/// Lanes of `lit` from which a sphere stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const Geometry<SphereKind, T>& spheres, const PacketLight<T>& light,
                         const ShadowRays<V>& rays, M lit) {
  const SphereLightView<T>& view = spheres.lights[light.index];
  const V3<V>& point = rays.from.point;
  if (light.rays == LightRays::parallel) {
    const LightPlaces<V> at = places_on(d, view.discs.plane, point);
    const V values[] = {at.u, at.v, at.w, rays.from.id};
    if (spheres.finder(ray_kind_of(light)) == Finder::one_by_one)
      return hn::And(lit, occluded_by_each(d, view.discs.casters.cell(0), view.discs.begins[1],
                                           DiscTest<T>(), values));
    return occluded_by_casters(d, view.discs, at, DiscTest<T>(), values, lit);
  }
  const V values[] = {point.x,        point.y,        point.z,   rays.towards.x,
                      rays.towards.y, rays.towards.z, rays.path, rays.from.id};
  const BallTest<T> test{view.is_far};
  if (spheres.finder(RayKind::to_point_light) == Finder::one_by_one)
    return hn::And(
        lit, occluded_by_each(d, view.balls.casters.cell(0), view.balls.begins[1], test, values));
  return occluded_by_casters(d, view.balls, light.place, point, test, values, lit);
}

/// Lanes of `lit` from which a sphere stands before the end of the axis that they look to.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const Geometry<SphereKind, T>& spheres, const LightAxis<D>& axis,
                         const ShadowRays<V>& rays, M lit) {
  // Beyond so many cells, points are tried in their own ones.
  constexpr int few_cells = 4;
  const CasterGrid<SphereDisc<T>, T>& grid = spheres.lights[axis.light.index].discs;
  const LightPlaces<V> at = places_on(d, grid.plane, rays.from.point);
  const V one = hn::Set(d, T(1));
  const V values[] = {at.u, at.v, at.w, rays.from.id,
                      hn::IfThenElse(axis.opposite_lanes, hn::Neg(one), one)};
  const PlaneWindow<T> window(grid.plane, axis.box);
  constexpr T most = std::numeric_limits<T>::max();
  const bool is_one_sided = hn::AllFalse(d, hn::And(lit, axis.opposite_lanes));
  const bool is_opposite = hn::AllFalse(d, hn::AndNot(axis.opposite_lanes, lit));
  const AxisDiscTest<T> test{window, is_opposite ? most : window.low_w,
                             is_one_sided ? -most : window.high_w};
  if (spheres.finder(RayKind::to_soft_light) == Finder::one_by_one)
    return hn::And(lit, occluded_by_each(d, grid.casters.cell(0), grid.begins[1], test, values));
  if (window.cell_count() > few_cells) return occluded_by_casters(d, grid, at, test, values, lit);
  const M dark = occluded_in_window(d, grid, window, test, values, lit);
  if (HWY_LIKELY(grid.wide.count == 0)) return dark;
  return hn::Or(dark, occluded_by_wide(d, grid, test, values, hn::AndNot(dark, lit)));
}

/// Asks the memory for what occluded_by() will need for the points of `lanes`. Cells around point
/// lights are not worth it: 400,000 spheres took 1.04 of the time.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void prefetch_cells(D d, const Geometry<SphereKind, T>& spheres,
                               const PacketLight<T>& light, const V3<V>& points, M lanes) {
  if (spheres.finder(RayKind::to_distant_light) != Finder::light_grid ||
      light.rays != LightRays::parallel)
    return;
  const CasterGrid<SphereDisc<T>, T>& grid = spheres.lights[light.index].discs;
  const LightPlaces<V> at = places_on(d, grid.plane, points);
  fetch_cells(d, grid, grid.casters, cell_of(d, grid.plane, at),
              hn::And(lanes, is_on_plane(d, grid.plane, at)));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

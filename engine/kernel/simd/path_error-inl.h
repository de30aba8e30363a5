// How far packets' rays are off, by what rounds and by what has magnified it on their way, and what
// that changes of the colours they see.
//
// A ray's error grows as the distance of two neighbouring rays does (Igehy: "Tracing Ray
// Differentials", 1999): over a distance by its error of direction, at a curved surface by the turn
// of the normal. Edges need no care: they are displaced by as small a part of a pixel as seen
// directly, for what a pixel sees has grown alike.

#include <limits>
#include <type_traits>

#include "engine/kernel/path_error.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Whether packets of T may have samples traced again in double.
template <typename T>
inline constexpr bool may_be_inexact = std::is_same_v<T, float>;

/// Of the lanes' rays, at most.
template <class V>
struct PathError {
  V place;      ///< across the ray, where it begins
  V direction;  ///< in radians
};

/// Of rays from the eye.
template <class D, class V = hn::Vec<D>>
HWY_INLINE PathError<V> eye_error(D d) {
  return {hn::Zero(d), hn::Zero(d)};
}

/// 1 / radius of the tightest curve through the points of `surface`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE V curvature_at(D d, const PacketScene<T>& scene, const Surface<D>& surface, M is_hit) {
  using Row = PrimitiveRow<T>;
  const V zero = hn::Zero(d);
  const Rows<D, Row> primitive(d, scene.primitives.data(), surface.at.id, is_hit);
  V curvature = primitive(d, &Row::curvature);
  const M own = hn::And(is_hit, hn::Lt(curvature, zero));
  if (scene.has_own_normals && !hn::AllFalse(d, own))
    for_each_geometry(scene,
                      [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                        if constexpr (HasOwnCurvatures<Kind>)
                          own_curvatures(d, scene.primitives, geometry, own, surface.at, curvature);
                      });
  // Of what does not tell it, nobody knows.
  curvature =
      hn::IfThenElse(hn::Lt(curvature, zero), hn::Set(d, std::numeric_limits<T>::max()), curvature);
  if (scene.corners.empty()) return curvature;
  const V item = primitive(d, &Row::item);
  const M told = hn::And(hn::And(is_hit, hn::Eq(curvature, zero)), hn::Gt(item, zero));
  if (hn::AllFalse(d, told)) return curvature;
  const Rows<D, CornerRow<T>> row(d, scene.corners.data(), hn::Sub(item, hn::Set(d, T(1))), told);
  return hn::IfThenElse(told, row(d, &CornerRow<T>::turn), curvature);
}

/// What rays that are off make of the surfaces that they hit.
template <class V>
struct SurfaceError {
  V place;  ///< across the ray
  V turn;   ///< of the normal, in radians
};

/// At t along a packet's rays.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE SurfaceError<V> surface_error(D d, const PacketScene<T>& scene,
                                         const Surface<D>& surface, const PathError<V>& error,
                                         const V3<V>& direction, V t, M is_hit) {
  const V3<V>& point = surface.at.point;
  const V size = hn::Add(hn::Abs(point.x), hn::Add(hn::Abs(point.y), hn::Abs(point.z)));
  const V rounding = hn::Mul(hn::Set(d, path_rounding<T>), hn::Add(size, t));
  const V place = hn::Add(hn::MulAdd(error.direction, t, error.place), rounding);
  const V bent = hn::Mul(place, curvature_at(d, scene, surface, is_hit));
  const V cosine = hn::Max(hn::Abs(dot(surface.at.normal, direction)),
                           hn::Set(d, std::numeric_limits<T>::min()));
  // A ray that is off by that much turns by no more where it just touches.
  const V most = hn::Sqrt(hn::Add(bent, bent));
  return {place, hn::Min(hn::Div(bent, cosine), most)};
}

/// The lanes whose points are beyond a light's reach.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M beyond_reach(D d, const ExactScene& exact, const V3<V>& point) {
  M beyond = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (const LampReach& lamp : exact.lamps) {
    const V3<V> path = sub(point, broadcast(d, lamp.place));
    beyond = hn::Or(beyond, hn::Gt(dot(path, path), hn::Set(d, lamp.reach2)));
  }
  return beyond;
}

/// By how much the lanes' colours may be off.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V colour_error(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                          const PathError<V>& error, const SurfaceError<V>& at) {
  using Row = MaterialRow<T>;
  // A highlight changes with the normal and with the ray, by the root of its exponent.
  const V root = hn::Sqrt(surface.material(d, &Row::shininess));
  const V highlight = hn::Mul(surface.material(d, &Row::ks),
                              hn::MulAdd(hn::Set(d, T(0.5)), error.direction, at.turn));
  const V change = hn::MulAdd(highlight, root, hn::Mul(surface.material(d, &Row::kd), at.turn));
  const V one = hn::Set(d, T(1));
  const V off = hn::Min(hn::Mul(change, hn::Set(d, scene.exact.brightest)), one);
  return hn::IfThenElse(beyond_reach(d, scene.exact, surface.at.point), one, off);
}

/// Of the rays that a surface sends on.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE PathError<V> error_beyond(D d, const PathError<V>& error, const SurfaceError<V>& at) {
  const V two = hn::Set(d, T(2));
  return {at.place, hn::MulAdd(two, at.turn, error.direction)};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

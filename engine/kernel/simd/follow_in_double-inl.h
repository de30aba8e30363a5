// Paths that other kernels carry in double: see exact_path-inl.h.

#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Lanes of a step, from the i-th on.
template <class D>
class StepLanes {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE StepLanes(D d, std::size_t i) : d_(d), i_(i) {}

  HWY_INLINE V get(const PathStep::Column& column) const {
    return hn::PromoteTo(d_, hn::Load(singles_, column.data() + i_));
  }
  HWY_INLINE V3<V> get(const PathStep::Vectors& from) const {
    return {get(from[0]), get(from[1]), get(from[2])};
  }
  HWY_INLINE V3<V> get(const PathStep::LongVectors& from) const {
    return add(get(from.rounded), get(from.rest));
  }
  HWY_INLINE void set(PathStep::Vectors& to, const V3<V>& values) const {
    set(to[0], values.x);
    set(to[1], values.y);
    set(to[2], values.z);
  }
  HWY_INLINE void set(PathStep::LongVectors& to, const V3<V>& values) const {
    set(to.rounded, values);
    set(to.rest, sub(values, get(to.rounded)));
  }

 private:
  HWY_INLINE void set(PathStep::Column& to, V values) const {
    hn::Store(hn::DemoteTo(singles_, values), singles_, to.data() + i_);
  }

  D d_;
  hn::Rebind<float, D> singles_;
  std::size_t i_;
};

/// Where rays meet what rows tell of, round or flat, that they are known to meet about at t. Those
/// that pass by, as near as rounding is, stay there.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V distance_by_row(D d, const Rows<D, PrimitiveRow<T>>& primitive, const V3<V>& place,
                             M round, M flat, const V3<V>& from, const V3<V>& direction, V t) {
  using Row = PrimitiveRow<T>;
  const V zero = hn::Zero(d);
  V exact = t;
  if (!hn::AllFalse(d, round)) {
    const V3<V> f = sub(from, place);
    const V b = hn::Neg(dot(f, direction));
    const V3<V> l = mul_add(direction, b, f);
    const V room = hn::Sub(primitive(d, &Row::radius_square), dot(l, l));
    const V root = hn::Sqrt(hn::Max(room, zero));
    // Of both, the one that is on the same side of the middle.
    exact = hn::Add(b, hn::CopySign(root, hn::Sub(t, b)));
  }
  if (!hn::AllFalse(d, flat)) {
    const V rest = hn::Add(primitive(d, &Row::eye_power), dot(place, from));
    exact = hn::IfThenElse(flat, hn::Div(hn::Neg(rest), dot(place, direction)), exact);
  }
  const M ahead =
      hn::And(hn::Gt(exact, zero), hn::Lt(exact, hn::Set(d, std::numeric_limits<T>::max())));
  return hn::IfThenElse(hn::And(hn::Or(round, flat), ahead), exact, t);
}

/// Moves the lanes of `own` of `at` to where rays meet what computes its normals itself, and takes
/// those. The lanes of `within` come from inside of something.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void meet_own(D d, const PacketScene<T>& scene, const RayOrigin<V>& from,
                           const V3<V>& direction, Hit<V> hit, M own, M within, RayOrigin<V>& at) {
  for_each_geometry(scene, [&]<class Kind>(
                               const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
    if constexpr (HasOwnDistances<Kind>) {
      const M leaving = geometry.transmits ? hn::And(own, within) : hn::AndNot(own, own);
      own_distances(d, scene.primitives, geometry, from, direction, hn::AndNot(leaving, own), hit);
      if (!hn::AllFalse(d, leaving))
        own_distances(d, scene.primitives, geometry, InnerOrigin<V>{from}, direction, leaving, hit);
    }
  });
  at.point = select(own, mul_add(direction, hit.t, from.point), at.point);
  at.normal = select(own, hit.normal, at.normal);
  for_each_geometry(scene,
                    [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                      if constexpr (HasOwnNormals<Kind>)
                        own_normals(d, scene.primitives, geometry, direction, own, at);
                      if constexpr (HasOwnSides<Kind>)
                        if (geometry.transmits)
                          own_sides(d, scene.primitives, geometry, direction, own, within, at);
                    });
}

/// Where the rays of a step meet what single has found, `active` lanes.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Meeting<V> meet_again(D d, const PacketScene<T>& scene, const PathStep& step,
                                 const StepLanes<D>& lanes, const V3<V>& direction, V id,
                                 M active) {
  using Row = PrimitiveRow<T>;
  const Rows<D, Row> primitive(d, scene.primitives.data(), id, active);
  const V zero = hn::Zero(d);
  const V curvature = primitive(d, &Row::curvature);
  const V3<V> place = primitive(d, &Row::place);
  const V3<V> from = lanes.get(step.from);
  const M round = hn::And(active, hn::Gt(curvature, zero));
  const M flat = hn::And(active, hn::Eq(curvature, zero));
  const V t = distance_by_row(d, primitive, place, round, flat, from, direction, lanes.get(step.t));
  const V3<V> point = mul_add(direction, t, from);
  const V3<V> normal = normal_by_row(d, scene, place, curvature, point, direction);
  const M own = hn::AndNot(hn::Or(round, flat), active);
  Meeting<V> met{point, normal, normal};
  // What functions out of line are told of is copied for them: it would stay in memory.
  if (scene.has_own_normals && !hn::AllFalse(d, own)) {
    const RayOrigin<V> left{from, lanes.get(step.from_normal), lanes.get(step.from_id), id, id};
    const Hit<V> hit{t, id, lanes.get(step.u), lanes.get(step.v)};
    RayOrigin<V> at{point, normal, id, hit.u, hit.v};
    meet_own(d, scene, left, direction, hit, own, hn::Gt(hit.u, zero), at);
    met = {at.point, at.normal, at.normal};
  }
  if (!scene.corners.empty()) {
    const V3<V> at = met.point;
    V3<V> shading_normal = met.normal;
    V3<V> color = met.normal;
    take_from_corners(d, scene, primitive, at, direction, active, shading_normal, color);
    met.shading_normal = shading_normal;
  }
  if (!scene.transmits) return met;
  const M is_other_side = hn::AndNot(own, hn::Lt(dot(met.normal, lanes.get(step.normal)), zero));
  met.normal = select(is_other_side, negate(met.normal), met.normal);
  met.shading_normal = select(is_other_side, negate(met.shading_normal), met.shading_normal);
  return met;
}

void follow_in_double(const PacketScene<double>& scene, PathStep& step) {
  using D = hn::ScalableTag<double>;
  const D d;
  for (std::size_t i = 0; i < step.lanes; i += hn::Lanes(d)) {
    const StepLanes<D> lanes(d, i);
    const auto id = lanes.get(step.id);
    const auto active = hn::Ge(id, hn::Zero(d));
    if (hn::AllFalse(d, active)) continue;
    const V3<hn::Vec<D>> direction = lanes.get(step.direction);
    const auto met = meet_again(d, scene, step, lanes, direction, id, active);
    lanes.set(step.at, met.point);
    const auto mirrored = reflected_at(d, scene, met, direction);
    // By a step of Newton's method from 1.
    const auto half_length2 = hn::Mul(hn::Set(d, 0.5), dot(mirrored, mirrored));
    lanes.set(step.mirrored, scale(mirrored, hn::Sub(hn::Set(d, 1.5), half_length2)));
    if (step.bends) {
      const auto ior = glass_of(d, scene, id, active)(d, &GlassRow<double>::ior);
      const auto from_within = hn::Gt(lanes.get(step.u), hn::Zero(d));
      const auto index = hn::IfThenElse(from_within, ior, hn::Div(hn::Set(d, 1.0), ior));
      lanes.set(step.refracted, refracted_at(d, scene, index, met, direction).direction);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

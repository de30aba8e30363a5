// Paths that other kernels carry in double, where they turn: see exact_path-inl.h.

#include <cstddef>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Rays of a batch, from the i-th on.
template <class D>
class TurningLanes {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE TurningLanes(D d, const TurningRays& rays, std::size_t i)
      : d_(d), columns_(rays.columns + i) {}

  HWY_INLINE V get(std::size_t column) const {
    return hn::PromoteTo(d_, hn::Load(singles_, columns_ + column * ray_stride<float>));
  }
  HWY_INLINE V3<V> get_vectors(std::size_t first) const {
    return {get(first), get(first + 1), get(first + 2)};
  }
  /// Vectors with what single rounds off of them, some 48 binary digits.
  HWY_INLINE V3<V> get_long(std::size_t first) const {
    return add(get_vectors(first), get_vectors(first + RayColumn::rests));
  }
  HWY_INLINE void set_long(std::size_t first, const V3<V>& values) const {
    set_long(first, values.x);
    set_long(first + 1, values.y);
    set_long(first + 2, values.z);
  }

 private:
  HWY_INLINE void set_long(std::size_t column, V value) const {
    const auto rounded = hn::DemoteTo(singles_, value);
    const auto rest = hn::DemoteTo(singles_, hn::Sub(value, hn::PromoteTo(d_, rounded)));
    hn::Store(rounded, singles_, columns_ + column * ray_stride<float>);
    hn::Store(rest, singles_, columns_ + (column + RayColumn::rests) * ray_stride<float>);
  }

  D d_;
  hn::Rebind<float, D> singles_;
  float* columns_;
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
  for_each_geometry(
      scene, [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
        if constexpr (HasOwnNormals<Kind>)
          own_normals(d, scene.primitives, geometry, direction, own, at);
        if constexpr (HasOwnSides<Kind>)
          if (V known = hn::Zero(d); geometry.transmits)
            own_sides(d, scene.primitives, geometry, direction, own, within, at, known);
      });
}

/// Where rays meet what they turn at, `active` lanes. A scene `is_plain` of which rows tell
/// everything and that lets no rays through.
template <bool is_plain, class D, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE Meeting<V> meet_again(D d, const PacketScene<T>& scene, const TurningLanes<D>& lanes,
                                 const V3<V>& direction, V id, M active) {
  using Row = PrimitiveRow<T>;
  using Column = RayColumn;
  const Rows<D, Row> primitive(d, scene.primitives.data(), id, active);
  const V zero = hn::Zero(d);
  const V curvature = primitive(d, &Row::curvature);
  const V3<V> place = primitive(d, &Row::place);
  const V3<V> from = lanes.get_long(Column::point);
  const M round = hn::And(active, hn::Gt(curvature, zero));
  const M flat = hn::And(active, hn::Eq(curvature, zero));
  const V t =
      distance_by_row(d, primitive, place, round, flat, from, direction, lanes.get(Column::t));
  const V3<V> point = mul_add(direction, t, from);
  const V3<V> normal = normal_by_row(d, scene, place, curvature, point, direction);
  Meeting<V> met{point, normal, normal};
  if constexpr (is_plain) return met;
  const M own = hn::AndNot(hn::Or(round, flat), active);
  // What functions out of line are told of is copied for them: it would stay in memory.
  if (scene.has_own_normals && !hn::AllFalse(d, own)) {
    const RayOrigin<V> left{from, lanes.get_vectors(Column::left_normal),
                            lanes.get(Column::left_id), id, id};
    Hit<V> hit{t, id, lanes.get(Column::u), lanes.get(Column::v)};
    hit.normal = lanes.get_vectors(Column::normal);
    RayOrigin<V> at{point, normal, id, hit.u, hit.v};
    const V side = scene.transmits ? lanes.get(Column::side) : zero;
    meet_own(d, scene, left, direction, hit, own, hn::Gt(side, zero), at);
    met = {at.point, at.normal, at.normal};
  }
  if (!scene.corners.empty()) {
    const V3<V> at = met.point;
    V3<V> shading_normal = met.normal;
    V3<V> color = met.normal;
    take_from_corners(d, scene, primitive, at, direction, active, shading_normal, color);
    met.shading_normal = shading_normal;
  }
  return met;
}

/// Where the `active` rays of a packet go from what they have met, where some are refracted.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> turned_at_glass(D d, const PacketScene<T>& scene, const TurningLanes<D>& lanes,
                                 const V3<V>& direction, V id, M active, Meeting<V> met) {
  const V zero = hn::Zero(d);
  const V turn = lanes.get(RayColumn::turn);
  const M mirrored = hn::And(active, hn::Eq(turn, hn::Set(d, T(Turn::mirrored))));
  const M refracted = hn::And(active, hn::Eq(turn, hn::Set(d, T(Turn::refracted))));
  // Of the side that single has found. Not where they are across: at a rim single may have met what
  // is beyond it.
  const V along = dot(met.normal, lanes.get_vectors(RayColumn::normal));
  const M is_other_side =
      hn::Lt(hn::IfThenElse(mirrored, along, hn::Neg(along)), hn::Set(d, T(-0.5)));
  met.normal = select(is_other_side, negate(met.normal), met.normal);
  met.shading_normal = select(is_other_side, negate(met.shading_normal), met.shading_normal);
  V3<V> on = direction;
  if (!hn::AllFalse(d, mirrored)) on = select(mirrored, reflected_at(d, scene, met, direction), on);
  if (!hn::AllFalse(d, refracted)) {
    const V ior = glass_of(d, scene, id, refracted)(d, &GlassRow<T>::ior);
    const M from_within = hn::Gt(lanes.get(RayColumn::side), zero);
    const V index = hn::IfThenElse(from_within, ior, hn::Div(hn::Set(d, T(1)), ior));
    on = select(refracted, refracted_at(d, scene, index, met, direction).direction, on);
  }
  return on;
}

/// Turns the `active` rays of a packet; `is_plain` as meet_again() has it.
template <bool is_plain, class D, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void turn_packet(D d, const PacketScene<T>& scene, const TurningLanes<D>& lanes,
                            M active) {
  using Column = RayColumn;
  const V id = hn::IfThenElseZero(active, lanes.get(Column::id));
  const V3<V> direction = lanes.get_long(Column::direction);
  const Meeting<V> met = meet_again<is_plain>(d, scene, lanes, direction, id, active);
  lanes.set_long(Column::point, met.point);
  const V3<V> on = !is_plain && scene.transmits
                       ? turned_at_glass(d, scene, lanes, direction, id, active, met)
                       : reflected_at(d, scene, met, direction);
  // To a length of 1, by a step of Newton's method from there.
  const V half_length2 = hn::Mul(hn::Set(d, T(0.5)), dot(on, on));
  lanes.set_long(Column::direction, scale(on, hn::Sub(hn::Set(d, T(1.5)), half_length2)));
}

void turn_in_double(const PacketScene<double>& scene, const TurningRays& rays) {
  using D = hn::ScalableTag<double>;
  const D d;
  const auto turn = [&]<bool is_plain>(std::bool_constant<is_plain>) HWY_ATTR {
    for (std::size_t i = 0; i < rays.count; i += hn::Lanes(d))
      turn_packet<is_plain>(d, scene, TurningLanes<D>(d, rays, i), hn::FirstN(d, rays.count - i));
  };
  if (scene.has_own_normals || !scene.corners.empty() || scene.transmits)
    turn(std::false_type());
  else
    turn(std::true_type());
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

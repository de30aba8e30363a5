// Light from discs and skies: the mean over places on them.

#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Writes down the points of a packet, of its lanes that are active.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void record_points(D d, const Surface<D>& surface, hn::Mask<D> active,
                                const LightSet<T>& light_set) {
  const auto bits = static_cast<typename LightLedger<T>::Lanes>(bits_of(d, active));
  T* const to = light_set.ledger->add_packet(light_set.index, bits);
  const V3<V>& point = surface.at.point;
  const V3<V>& normal = surface.at.normal;
  const V values[] = {point.x,          point.y,      point.z,          normal.x,
                      normal.y,         normal.z,     surface.normal.x, surface.normal.y,
                      surface.normal.z, surface.at.id};
  for (std::size_t i = 0; i < LightLedger<T>::column_count; ++i)
    hn::StoreU(values[i], d, to + i * hn::Lanes(d));
}

/// How soft lights reach a packet's points.
template <class D, class Between, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
class SoftLightOnPacket {
 public:
  /// `active`: at least one; `light_set`: of the places; `packet`: its number in the ledger, if
  /// there is one. All are referred to.
  HWY_INLINE SoftLightOnPacket(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                               M active, const LightSet<T>& light_set, std::size_t packet,
                               Between& between)
      : d_(d),
        scene_(scene),
        surface_(surface),
        box_(box_around(d, surface.at.point, active)),
        light_set_(light_set),
        packet_(packet),
        between_(between) {}

  /// The share of a disc of directions that the lanes of `lit` have, by some of its places; 0 in
  /// others.
  HWY_INLINE V share_of_distant(const PacketSoftLight<T>& soft, const PlaceRange& range,
                                M lit) const {
    V sum = hn::Zero(d_);
    const M none = hn::AndNot(lit, lit);
    for_each_place(range, [&](std::size_t i, std::size_t told) HWY_ATTR {
      sum = hn::Add(
          sum, share_along(soft.directions[i], nullptr, none,
                           broadcast(d_, soft.directions[i].place), soft.first_told + told, lit));
    });
    return hn::Mul(sum, hn::Set(d_, T(1) / static_cast<T>(range.count)));
  }

  /// A disc around a place, and what may hide it from any of the points.
  struct Lamp {
    const PacketSoftLight<T>& soft;
    LightCandidates<T> candidates;
    V3<V> path;  ///< to its middle
    BasisPacket<V> around;
  };
  HWY_INLINE Lamp lamp(const PacketSoftLight<T>& soft, const ArrivingLights<V>& middle) const {
    const Shaft<T> shaft(box_, soft.light.place, soft.size);
    const bool is_searched = Between::hides_all && scene_.shadows != Shadows::off;
    return {soft, LightCandidates<T>(scene_, shaft, is_searched),
            scale(middle.towards, middle.path), basis_across(d_, middle.towards)};
  }

  /// Likewise of a disc around a place.
  HWY_INLINE V share_of_point(const Lamp& lamp, const PlaceRange& range, M lit) const {
    V sum = hn::Zero(d_);
    for_each_place(range, [&](std::size_t i, std::size_t) HWY_ATTR {
      const V across = hn::Set(d_, lamp.soft.places[i].x * lamp.soft.size);
      const V along = hn::Set(d_, lamp.soft.places[i].y * lamp.soft.size);
      const V3<V> to = mul_add(lamp.around.u, across, mul_add(lamp.around.v, along, lamp.path));
      const V distance = hn::Sqrt(dot(to, to));
      const V3<V> towards = unit(d_, to);
      if constexpr (Between::hides_all)
        sum = hn::Add(sum, share_along(towards, distance, lit, lamp.candidates));
      else
        sum = hn::Add(sum, share_along(towards, distance, lit));
    });
    return hn::Mul(sum, hn::Set(d_, T(1) / static_cast<T>(range.count)));
  }

  /// Likewise of a sky: by the cosine.
  HWY_INLINE V share_of_sky(const PacketSoftLight<T>& soft, const PlaceRange& range,
                            M active) const {
    const V zero = hn::Zero(d_);
    V sum = zero;
    V weights = zero;
    const bool is_shared = !soft.directions.empty();
    for_each_place(range, [&](std::size_t i, std::size_t told) HWY_ATTR {
      const V3<V> axis = broadcast(d_, is_shared ? soft.directions[i].place : soft.places[i]);
      const V cosine = dot(surface_.normal, axis);
      const M opposite = hn::Lt(cosine, zero);
      const V weight = hn::Abs(cosine);
      weights = hn::Add(weights, weight);
      V share;
      if (is_shared) {
        share = share_along(soft.directions[i], &soft.opposites[i], opposite, axis,
                            soft.first_told + told, active);
      } else {
        const V3<V> towards = select(opposite, negate(axis), axis);
        share = share_along(towards, hn::Set(d_, soft.size), active);
      }
      sum = hn::MulAdd(weight, share, sum);
    });
    return hn::IfThenElseZero(hn::And(active, hn::Gt(weights, zero)), hn::Div(sum, weights));
  }

  /// Lanes of `lit` that see something of a light, of which they have the share `had` by their own
  /// set: where that is nothing, its rim and other sets are asked, too. share_of(range, lanes) is
  /// what lanes have.
  template <class ShareOf>
  HWY_INLINE M sees_any(const PlaceNumbers& numbers, V had, M lit, const ShareOf& share_of) const {
    M dark = hn::AndNot(hn::Gt(had, hn::Zero(d_)), lit);
    const auto look = [&](const PlaceRange& range) HWY_ATTR {
      dark = hn::AndNot(hn::Gt(share_of(range, dark), hn::Zero(d_)), dark);
    };
    for (std::size_t i = 0; i < numbers.rim_runs() && !hn::AllFalse(d_, dark); ++i)
      look(numbers.of_rim(i));
    for (int i = 1; i < scene_.sets_to_be_sure && !hn::AllFalse(d_, dark); ++i)
      look(numbers.of_set((light_set_.index + static_cast<std::size_t>(i)) % numbers.sets));
    return hn::AndNot(dark, lit);
  }

 private:
  /// Calls visit(place, its number among those that a ledger tells of).
  template <class Visit>
  HWY_INLINE void for_each_place(const PlaceRange& range, const Visit& visit) const {
    for (std::size_t i = 0; i < range.count; ++i) visit(range.first + i, range.told + i);
  }

  /// From a direction that rays share, or in the lanes of `opposites` from its opposite; its place
  /// in the ledger.
  HWY_INLINE V share_along(const PacketLight<T>& direction, const PacketLight<T>* opposite,
                           M opposites, const V3<V>& axis, std::size_t place, M lit) const {
    const V one = hn::Set(d_, T(1));
    const V slope = dot(surface_.at.normal, axis);
    const V above = hn::IfThenElse(opposites, hn::Neg(slope), slope);
    lit = hn::And(lit, hn::Gt(above, hn::Zero(d_)));
    if (scene_.shadows == Shadows::off) return hn::IfThenElseZero(lit, one);
    if (light_set_.is_told())
      lit = hn::AndNot(mask_of(d_, light_set_.ledger->dark(place, packet_)), lit);
    if (hn::AllFalse(d_, lit)) return hn::Zero(d_);
    const V far_away = hn::Set(d_, std::numeric_limits<T>::max());
    const V3<V> towards = select(opposites, negate(axis), axis);
    const ShadowRays<V> rays{surface_.at, towards, far_away, above};
    lit =
        between_.reached(d_, scene_, LightAxis<D>{direction, opposite, opposites, box_}, rays, lit);
    return hn::IfThenElseZero(lit, between_.weakened(one));
  }
  /// From wherever each lane's ray goes.
  HWY_INLINE V share_along(const V3<V>& towards, V distance, M lit) const {
    const V above = dot(surface_.at.normal, towards);
    lit = hn::And(lit, hn::Gt(above, hn::Zero(d_)));
    if (scene_.shadows == Shadows::off) return hn::IfThenElseZero(lit, hn::Set(d_, T(1)));
    if (hn::AllFalse(d_, lit)) return hn::Zero(d_);
    return between_.share_along(d_, scene_, ShadowRays<V>{surface_.at, towards, distance, above},
                                lit);
  }

  /// The same where candidates hide all that they stand before.
  HWY_INLINE V share_along(const V3<V>& towards, V distance, M lit,
                           const LightCandidates<T>& candidates) const {
    const V above = dot(surface_.at.normal, towards);
    lit = hn::And(lit, hn::Gt(above, hn::Zero(d_)));
    if (scene_.shadows != Shadows::off)
      lit = hn::AndNot(candidates.occluded(
                           d_, scene_, ShadowRays<V>{surface_.at, towards, distance, above}, lit),
                       lit);
    return hn::IfThenElseZero(lit, hn::Set(d_, T(1)));
  }

  D d_;
  const PacketScene<T>& scene_;
  const Surface<D>& surface_;
  PointBox<T> box_;
  const LightSet<T>& light_set_;
  std::size_t packet_;
  Between& between_;
};

/// The sum of what soft lights make of a packet's points, without their colours; `ambient` comes
/// with each light that is seen.
template <class D, class Between, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE V3<V> soft_light(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                              const MaterialPacket<D>& material, V ambient, M active,
                              const LightSet<T>& light_set, Between& between) {
  const V zero = hn::Zero(d);
  const std::size_t packet = light_set.is_told() ? light_set.ledger->take_turn() : 0;
  const SoftLightOnPacket<D, Between> light(d, scene, surface, active, light_set, packet, between);
  V3<V> sum{zero, zero, zero};
  const bool has_ambient = !hn::AllTrue(d, hn::Le(ambient, zero));
  for (const PacketSoftLight<T>& soft : scene.soft_lights) {
    const bool is_sky = soft.shape == LightShape::sky;
    ArrivingLights<V> middle;
    M lit = active;
    V incidence = zero;
    if (!is_sky) {
      middle = arriving_light(d, soft.light, surface.at.point);
      incidence = dot(surface.normal, middle.towards);
      lit = hn::And(active, hn::Gt(incidence, zero));
      if (hn::AllFalse(d, lit)) continue;
    }
    const auto add_light = [&](const auto& share_of) HWY_ATTR {
      const V had = hn::IfThenElseZero(lit, share_of(soft.numbers.of_set(light_set.index), lit));
      const V reflected =
          is_sky ? material.diffuse() : material.share(d, middle.towards, incidence);
      const V share = hn::IfThenElseZero(hn::Gt(had, zero), hn::Mul(had, reflected));
      V shown = zero;
      if (has_ambient)
        shown = hn::IfThenElseZero(light.sees_any(soft.numbers, had, lit, share_of), ambient);
      const V3<V> emission = is_sky ? broadcast(d, soft.light.emission) : middle.emission;
      sum = add(sum, mul_add(emission, share, V3<V>{shown, shown, shown}));
    };
    if (is_sky) {
      add_light([&](const PlaceRange& range, M lanes)
                    HWY_ATTR { return light.share_of_sky(soft, range, lanes); });
    } else if (!soft.directions.empty()) {
      add_light([&](const PlaceRange& range, M lanes)
                    HWY_ATTR { return light.share_of_distant(soft, range, lanes); });
    } else {
      const auto lamp = light.lamp(soft, middle);
      add_light([&](const PlaceRange& range, M lanes)
                    HWY_ATTR { return light.share_of_point(lamp, range, lanes); });
    }
  }
  return sum;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

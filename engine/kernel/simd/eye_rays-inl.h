// Rays from the eye.

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Points of the image that a packet's rays go through, in pixels: `right` of and `down` from
/// (x, y), where y = 0 is the image's lower edge.
template <class V>
struct ImagePoints {
  double x;
  double y;
  V right;
  V down;
};

/// The directions from the eye through an image's points, and what is seen along them.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
class EyeRays {
 public:
  HWY_INLINE EyeRays(D, const PacketScene<T>& scene)
      : scene_(scene), step_x_(2.0 / scene.view.width), step_y_(2.0 / scene.view.height) {}

  /// The image point runs from -1 to 1; that of (x, y) is computed in double, T is enough from
  /// there.
  HWY_INLINE V3<V> direction(D d, const ImagePoints<V>& points) const {
    return unit(d, through(d, points));
  }

  /// The same, but of any length.
  HWY_INLINE V3<V> through(D d, const ImagePoints<V>& points) const {
    const V across = hn::MulAdd(points.right, hn::Set(d, static_cast<T>(step_x_)),
                                hn::Set(d, static_cast<T>(points.x * step_x_ - 1)));
    const V up = hn::NegMulAdd(points.down, hn::Set(d, static_cast<T>(step_y_)),
                               hn::Set(d, static_cast<T>(points.y * step_y_ - 1)));
    return mul_add(broadcast(d, scene_.right), across,
                   mul_add(broadcast(d, scene_.up), up, broadcast(d, scene_.forward)));
  }

  /// What the active lanes hit of their candidates.
  template <class Candidates>
  HWY_INLINE Hit<V> intersect(D d, Candidates& candidates, const V3<V>& direction,
                              hn::Mask<D> active) const {
    const V none = hn::Set(d, T(-1));
    const RayOrigin<V> eye = origin(d);
    Hit<V> hit{hn::Set(d, std::numeric_limits<T>::max()), none, none, none};
    for_each_geometry(scene_, [&](const auto& geometry) RAYTRACER_INLINE_ATTR {
      intersect_from_eye(d, scene_, geometry, candidates, eye, direction, active, hit);
    });
    return hit;
  }

  /// The colours of what they hit, not yet clamped. `pixel` has their numbers for `followed`, which
  /// keeps the rays that follow; `light_set` is of places on soft lights; rest() is what T rounds
  /// off of the directions, if paths are carried in double.
  template <class Rest, class Followed>
  HWY_INLINE V3<V> shade(D d, const V3<V>& direction, const Rest& rest, const Hit<V>& hit,
                         hn::Mask<D> active, V pixel, const LightSet<T>& light_set,
                         Followed& followed) const {
    const V zero = hn::Zero(d);
    const Packet<V> packet{
        origin(d), direction, hn::Set(d, T(1)), pixel, hn::Set(d, static_cast<T>(scene_.max_depth)),
        zero,      light_set};
    const auto rest_of_rays = [&]() HWY_ATTR { return RayRest<V>{{zero, zero, zero}, rest()}; };
    return shade_packet(d, scene_, packet, rest_of_rays, hit, active, followed,
                        static_cast<V*>(nullptr));
  }

  HWY_INLINE RayOrigin<V> origin(D d) const {
    const V zero = hn::Zero(d);
    const V none = hn::Set(d, T(-1));
    return {{zero, zero, zero}, {zero, zero, zero}, none, none, none};
  }

  const PacketScene<T>& scene() const { return scene_; }

 private:
  const PacketScene<T>& scene_;
  double step_x_;
  double step_y_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

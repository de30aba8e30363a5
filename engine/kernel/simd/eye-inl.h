// What is seen from the eye.

#if defined(RAYTRACER_KERNEL_SIMD_EYE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_EYE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_EYE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_EYE_INL_H_
#endif

#include <cstdint>
#include <limits>

#include "engine/kernel/simd/rays-inl.h"
#include "engine/kernel/simd/reflect-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// The directions from the eye through an image's points, and what is seen along them.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
class EyeRays {
 public:
  HWY_INLINE EyeRays(D, const SimdScene<T>& scene)
      : scene_(scene), step_x_(2.0 / scene.view.width), step_y_(2.0 / scene.view.height) {}

  /// Through points `right` of and `down` from (x, y), in pixels, y = 0 at the bottom. The image
  /// point runs from -1 to 1; that of (x, y) is computed in double, T is enough from there.
  HWY_INLINE V3<V> direction(D d, double x, double y, V right, V down) const {
    const V across = hn::MulAdd(right, hn::Set(d, static_cast<T>(step_x_)),
                                hn::Set(d, static_cast<T>(x * step_x_ - 1)));
    const V up = hn::NegMulAdd(down, hn::Set(d, static_cast<T>(step_y_)),
                               hn::Set(d, static_cast<T>(y * step_y_ - 1)));
    return unit(d, mul_add(broadcast(d, scene_.right), across,
                           mul_add(broadcast(d, scene_.up), up, broadcast(d, scene_.forward))));
  }

  /// What the active lanes meet of `contents`, as PartContents.
  template <class Contents>
  HWY_INLINE Nearest<V> meet(D d, const Contents& contents, const V3<V>& direction,
                             hn::Mask<D> active) const {
    const V none = hn::Set(d, T(-1));
    const Start<V> eye = start(d);
    Nearest<V> nearest{hn::Set(d, std::numeric_limits<T>::max()), none, none, none};
    if (scene_.has_sphere_bins)
      show_spheres_to_eye(d, scene_, contents, direction, active, nearest);
    else if (scene_.has_spheres)
      show_tree(d, scene_.sphere_tree, eye, direction, active, nearest);
    if (scene_.has_triangle_bins)
      show_triangles_to_eye(d, scene_, contents, direction, active, nearest);
    else if (scene_.has_triangles)
      show_tree(d, scene_.triangle_tree, eye, direction, active, nearest);
    show_planes(d, scene_, eye, direction, active, nearest);
    if (contents.may_show_square()) show_squares<false>(d, scene_, eye, direction, active, nearest);
    return nearest;
  }

  /// The colours of what they met, not yet clamped. They are the block's from `first` on for
  /// `reflected`, which keeps what they mirror.
  HWY_INLINE V3<V> shade(D d, const V3<V>& direction, const Nearest<V>& nearest, hn::Mask<D> active,
                         std::size_t first, RayBlock<T>& reflected) const {
    const Packet<V> packet{start(d), direction, hn::Set(d, T(1)),
                           hn::Iota(d, static_cast<T>(first))};
    return shade_packet(d, scene_, packet, nearest, active, scene_.reflects, reflected);
  }

  const SimdScene<T>& scene() const { return scene_; }

 private:
  HWY_INLINE Start<V> start(D d) const {
    const V zero = hn::Zero(d);
    const V none = hn::Set(d, T(-1));
    return {{zero, zero, zero}, {zero, zero, zero}, none, none, none};
  }

  const SimdScene<T>& scene_;
  double step_x_;
  double step_y_;
};

/// What packets have met, one after another.
template <typename T>
struct Sights {
  alignas(64) T direction_x[block_pixels], direction_y[block_pixels], direction_z[block_pixels];
  alignas(64) T t[block_pixels], id[block_pixels], first[block_pixels], second[block_pixels];
  alignas(64) T normal_x[block_pixels], normal_y[block_pixels], normal_z[block_pixels];
};

/// Asks the memory for what shading the i-th packet, if there is one, will need of light grids.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void fetch_for_shading(D d, const SimdScene<T>& scene, const Sights<T>& sights,
                                  const Rays& rays, int i) {
  if (i >= rays.count() || !rays.is_in(i)) return;
  const std::size_t at = static_cast<std::size_t>(i) * PacketShape<D>::lanes;
  const auto hit = hn::And(rays.active(d, i), hn::Ge(hn::Load(d, sights.id + at), hn::Zero(d)));
  const auto direction =
      load(d, sights.direction_x + at, sights.direction_y + at, sights.direction_z + at);
  fetch_light_cells(d, scene, scale(direction, hn::Load(d, sights.t + at)), hit);
}

/// The colours that packets of rays from the eye see, not yet clamped; at most as many as a block
/// has pixels. If `fetches`, what shading a packet will need is fetched before its turn. `rays` has
/// count() packets, and for the i-th of them, if is_in(i), direction(d, i), the active(d, i) lanes,
/// and the contents(i) of what they go through.
///
/// All packets meet what they meet before any is shaded: in so short chains of what waits for what
/// a processor works on several packets at a time.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void trace_packets(D d, const EyeRays<D>& eye, const Rays& rays, bool fetches,
                              BlockColours<T>& colours) {
  using V = hn::Vec<D>;
  constexpr int lanes = PacketShape<D>::lanes;
  const SimdScene<T>& scene = eye.scene();
  RayBlock<T> reflected;
  Sights<T> sights;
  for (int i = 0; i < rays.count(); ++i) {
    if (!rays.is_in(i)) continue;
    const std::size_t at = static_cast<std::size_t>(i) * lanes;
    const V3<V> direction = rays.direction(d, i);
    const Nearest<V> nearest = eye.meet(d, rays.contents(i), direction, rays.active(d, i));
    hn::Store(direction.x, d, sights.direction_x + at);
    hn::Store(direction.y, d, sights.direction_y + at);
    hn::Store(direction.z, d, sights.direction_z + at);
    hn::Store(nearest.t, d, sights.t + at);
    hn::Store(nearest.id, d, sights.id + at);
    if (scene.squares.empty()) continue;
    hn::Store(nearest.first, d, sights.first + at);
    hn::Store(nearest.second, d, sights.second + at);
    hn::Store(nearest.normal.x, d, sights.normal_x + at);
    hn::Store(nearest.normal.y, d, sights.normal_y + at);
    hn::Store(nearest.normal.z, d, sights.normal_z + at);
  }
  if (fetches) fetch_for_shading(d, scene, sights, rays, 0);
  for (int i = 0; i < rays.count(); ++i) {
    if (fetches) fetch_for_shading(d, scene, sights, rays, i + 1);
    if (!rays.is_in(i)) continue;
    const std::size_t at = static_cast<std::size_t>(i) * lanes;
    const V none = hn::Set(d, T(-1));
    Nearest<V> nearest{hn::Load(d, sights.t + at), hn::Load(d, sights.id + at), none, none};
    if (!scene.squares.empty()) {
      nearest.first = hn::Load(d, sights.first + at);
      nearest.second = hn::Load(d, sights.second + at);
      nearest.normal = load(d, sights.normal_x + at, sights.normal_y + at, sights.normal_z + at);
    }
    const V3<V> direction =
        load(d, sights.direction_x + at, sights.direction_y + at, sights.direction_z + at);
    store(d, eye.shade(d, direction, nearest, rays.active(d, i), at, reflected), at, colours);
  }
  if (reflected.count > 0) trace_reflections(scene, reflected, colours);
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

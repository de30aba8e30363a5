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

/// What rays from the eye may meet in a block.
struct BlockContents {
  BlockEntries spheres;
  BlockEntries triangles;
  std::uint32_t square_parts;  ///< parts that may show a square, as in BlockEntries
  std::uint32_t parts;         ///< parts that may show anything

  template <typename T>
  BlockContents(const SimdScene<T>& scene, int column, int row)
      : spheres(scene.bins.block(column, row)),
        triangles(scene.bins.block_triangles(column, row)),
        square_parts(scene.bins.square_parts(column, row)),
        parts(square_parts) {
    constexpr std::uint32_t all = 0xFFFF;
    for (const BlockEntries& block : {spheres, triangles})
      for (std::size_t i = 0; i < block.entries.size(); ++i) parts |= block.parts[i];
    const bool by_tree = (scene.has_triangles && !scene.has_triangle_bins) ||
                         (!scene.spheres.empty() && !scene.has_sphere_bins);
    if (!scene.planes.empty() || by_tree) parts = all;
  }
};

/// The directions from the eye through an image's points, and what they see.
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

  /// The colours that the active lanes see through `part` of a block, not yet clamped. They are the
  /// block's from `first` on for `reflected`, which keeps what they mirror.
  HWY_INLINE V3<V> trace(D d, const BlockContents& contents, int part, const V3<V>& direction,
                         hn::Mask<D> active, std::size_t first, RayBlock<T>& reflected) const {
    const V zero = hn::Zero(d);
    const V none = hn::Set(d, T(-1));
    const Start<V> eye{{zero, zero, zero}, {zero, zero, zero}, none, none, none};
    Nearest<V> nearest{hn::Set(d, std::numeric_limits<T>::max()), none, none, none};
    if (scene_.has_sphere_bins)
      show_spheres_to_eye(d, scene_, contents.spheres, part, direction, active, nearest);
    else if (!scene_.spheres.empty())
      show_tree(d, scene_.sphere_tree, eye, direction, active, nearest);
    if (scene_.has_triangle_bins)
      show_triangles_to_eye(d, scene_, contents.triangles, part, direction, active, nearest);
    else if (scene_.has_triangles)
      show_tree(d, scene_.triangle_tree, eye, direction, active, nearest);
    show_planes(d, scene_, eye, direction, active, nearest);
    if ((contents.square_parts >> part & 1U) != 0)
      show_squares<false>(d, scene_, eye, direction, active, nearest);
    const Packet<V> packet{eye, direction, hn::Set(d, T(1)), hn::Iota(d, static_cast<T>(first))};
    return shade_packet(d, scene_, packet, nearest, active, scene_.reflects, reflected);
  }

 private:
  const SimdScene<T>& scene_;
  double step_x_;
  double step_y_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

// Rays after a reflection: those that still matter side by side, a bounce of all at a time.

#if defined(RAYTRACER_KERNEL_SIMD_REFLECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_REFLECT_INL_H_
#undef RAYTRACER_KERNEL_SIMD_REFLECT_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_REFLECT_INL_H_
#endif

#include <limits>
#include <utility>

#include "engine/kernel/simd/block-inl.h"
#include "engine/kernel/simd/rays-inl.h"
#include "engine/kernel/simd/shade-inl.h"
#include "engine/kernel/simd/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Rays after a reflection, those that still matter side by side.
template <typename T>
struct RayBlock {
  int count = 0;
  alignas(64) T direction_x[block_pixels + 64], direction_y[block_pixels + 64],
      direction_z[block_pixels + 64];
  alignas(64) T point_x[block_pixels + 64], point_y[block_pixels + 64], point_z[block_pixels + 64];
  alignas(64) T normal_x[block_pixels + 64], normal_y[block_pixels + 64],
      normal_z[block_pixels + 64];
  alignas(64) T id[block_pixels + 64], first[block_pixels + 64], second[block_pixels + 64];
  alignas(64) T weight[block_pixels + 64];
  alignas(64) T pixel[block_pixels + 64];  ///< its index in the block
};

/// A packet of rays with what they have met.
template <class V>
struct Packet {
  Start<V> from;
  V3<V> direction;
  V weight;
  V pixel;
};

/// The order that puts the lanes of `mask`, at least one, first. Made once for all values to be
/// stored: Highway's Compress copies a table at each call, and CompressStore is slow on some
/// processors.
template <class D, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE auto compressing_order(D d, M mask) {
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  HWY_ALIGN hwy::MakeSigned<T> order[most_lanes] = {};
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < most_lanes; ++lane) {
    order[count] = static_cast<hwy::MakeSigned<T>>(lane);
    count += bytes[lane / 8] >> (lane % 8) & 1U;
  }
  return hn::SetTableIndices(d, order);
}

/// The colours that a packet sees; what it mirrors is kept for `reflected`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_packet(D d, const SimdScene<T>& scene, const Packet<V>& packet,
                              const Nearest<V>& nearest, M active, bool reflects,
                              RayBlock<T>& reflected) {
  const V zero = hn::Zero(d);
  const M hit = hn::And(active, hn::Ge(nearest.id, zero));
  const V3<V> background = broadcast(d, scene.background);
  if (hn::AllFalse(d, hit)) return background;
  const Surface<D> surface = surface_at(d, scene, packet.from, packet.direction, nearest, hit);
  const V3<V> colour =
      select(hit, shade(d, scene, surface, negate(packet.direction), hit), background);
  if (!reflects) return colour;

  const V weight = hn::Mul(packet.weight, surface.material(d, scene.materials.reflectivity));
  const M mirrors = hn::And(hit, hn::Gt(weight, zero));
  if (hn::AllFalse(d, mirrors)) return colour;
  const V twice = hn::Mul(hn::Set(d, T(-2)), dot(packet.direction, surface.at.normal));
  const V3<V> direction = unit(d, mul_add(surface.at.normal, twice, packet.direction));
  const auto first_mirrors = compressing_order(d, mirrors);
  const auto keep = [&](V values, T* column_of_block) HWY_ATTR {
    hn::StoreU(hn::TableLookupLanes(values, first_mirrors), d, column_of_block + reflected.count);
  };
  keep(direction.x, reflected.direction_x);
  keep(direction.y, reflected.direction_y);
  keep(direction.z, reflected.direction_z);
  keep(surface.at.point.x, reflected.point_x);
  keep(surface.at.point.y, reflected.point_y);
  keep(surface.at.point.z, reflected.point_z);
  keep(surface.at.normal.x, reflected.normal_x);
  keep(surface.at.normal.y, reflected.normal_y);
  keep(surface.at.normal.z, reflected.normal_z);
  keep(surface.at.id, reflected.id);
  keep(surface.at.first, reflected.first);
  keep(surface.at.second, reflected.second);
  keep(weight, reflected.weight);
  keep(packet.pixel, reflected.pixel);
  reflected.count += static_cast<int>(count_true(d, mirrors));
  return colour;
}

/// One bounce of a block of reflected rays: adds what they see, returns what they mirror.
template <typename T>
void trace_reflected(const SimdScene<T>& scene, const RayBlock<T>& rays, bool reflects,
                     RayBlock<T>& reflected, BlockColours<T>& colours) {
  const hn::ScalableTag<T> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  reflected.count = 0;
  for (int i = 0; i < rays.count; i += lanes) {
    const auto active = hn::FirstN(d, static_cast<std::size_t>(rays.count - i));
    // Lanes beyond the last ray hold what was there: kept from becoming indices or NaN traps.
    const auto at = [&](const T* values)
                        HWY_ATTR { return hn::IfThenElseZero(active, hn::LoadU(d, values + i)); };
    const Packet<V> packet{{{at(rays.point_x), at(rays.point_y), at(rays.point_z)},
                            {at(rays.normal_x), at(rays.normal_y), at(rays.normal_z)},
                            at(rays.id),
                            at(rays.first),
                            at(rays.second)},
                           {at(rays.direction_x), at(rays.direction_y), at(rays.direction_z)},
                           at(rays.weight),
                           at(rays.pixel)};
    const V none = hn::Set(d, T(-1));
    Nearest<V> nearest{hn::Set(d, std::numeric_limits<T>::max()), none, none, none};
    if (scene.sphere_tree.is_empty()) {
      for (const SimdSphere<T>& sphere : scene.spheres)
        show_sphere(d, sphere, packet.from, packet.direction, active, nearest);
    } else {
      show_tree(d, scene.sphere_tree, packet.from, packet.direction, active, nearest);
    }
    if (!scene.triangle_tree.is_empty())
      show_tree(d, scene.triangle_tree, packet.from, packet.direction, active, nearest);
    show_planes(d, scene, packet.from, packet.direction, active, nearest);
    show_squares<true>(d, scene, packet.from, packet.direction, active, nearest);

    const V3<V> colour = shade_packet(d, scene, packet, nearest, active, reflects, reflected);
    alignas(64) T weighted[3][HWY_MAX_BYTES / sizeof(T)];
    hn::Store(hn::Mul(colour.x, packet.weight), d, weighted[0]);
    hn::Store(hn::Mul(colour.y, packet.weight), d, weighted[1]);
    hn::Store(hn::Mul(colour.z, packet.weight), d, weighted[2]);
    for (int lane = 0; lane < lanes && i + lane < rays.count; ++lane) {
      const auto pixel = static_cast<std::size_t>(rays.pixel[i + lane]);
      colours.red[pixel] += weighted[0][lane];
      colours.green[pixel] += weighted[1][lane];
      colours.blue[pixel] += weighted[2][lane];
    }
  }
}

/// Follows reflected rays to the scene's depth and adds what they see.
template <typename T>
void trace_reflections(const SimdScene<T>& scene, RayBlock<T>& rays, BlockColours<T>& colours) {
  RayBlock<T> reflected;
  for (int depth = 1; rays.count > 0; ++depth) {
    trace_reflected(scene, rays, depth < scene.max_depth, reflected, colours);
    std::swap(rays, reflected);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

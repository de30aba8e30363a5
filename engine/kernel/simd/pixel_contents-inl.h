// What rays from the eye may meet in one pixel.

#if defined(RAYTRACER_KERNEL_SIMD_PIXEL_CONTENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_PIXEL_CONTENTS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_PIXEL_CONTENTS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_PIXEL_CONTENTS_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include "engine/kernel/simd/contents-inl.h"
#include "engine/kernel/simd/eye-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// A cone that holds all rays from the eye through a pixel.
template <typename T>
struct PixelCone {
  Triple<T> axis;  ///< unit
  T spread;        ///< how far unit vectors in it are from the axis, at most, and a little more

  /// Whether a ray in the cone may meet the sphere of this row of a PrimitiveTable. Where it comes
  /// nearest to the centre it has gone no farther than that is away, so the axis passes the centre
  /// at no more than the radius and `spread` times that distance.
  HWY_INLINE bool may_meet(const T* row) const {
    using Table = PrimitiveTable<T>;
    const T b = axis.x * row[Table::x] + axis.y * row[Table::y] + axis.z * row[Table::z];
    const T lx = row[Table::x] - axis.x * b;
    const T ly = row[Table::y] - axis.y * b;
    const T lz = row[Table::z] - axis.z * b;
    const T distance2 = row[Table::eye_c] + row[Table::radius2];
    const T reach = std::sqrt(row[Table::radius2]) + spread * std::sqrt(distance2);
    return !(lx * lx + ly * ly + lz * lz > reach * reach);
  }
};

/// Around the pixel whose lower left corner is (x, y), y = 0 at the bottom. Its corners are
/// farthest from the axis: the pixel is convex, and so is what a cone of less than a right angle
/// cuts out of the image.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE PixelCone<T> cone_around(D d, const EyeRays<D>& eye, double x, double y) {
  const auto through = [&](double right, double up) HWY_ATTR {
    const auto zero = hn::Zero(d);
    const auto direction = eye.direction(d, x + right, y + up, zero, zero);
    return Triple<T>{hn::GetLane(direction.x), hn::GetLane(direction.y), hn::GetLane(direction.z)};
  };
  const Triple<T> axis = through(0.5, 0.5);
  T chord2 = 0;
  for (const double right : {0.0, 1.0})
    for (const double up : {0.0, 1.0}) {
      const Triple<T> corner = through(right, up);
      const T dx = corner.x - axis.x;
      const T dy = corner.y - axis.y;
      const T dz = corner.z - axis.z;
      chord2 = std::max(chord2, dx * dx + dy * dy + dz * dz);
    }
  // More than rounding may change of this and of what a ray's test finds.
  constexpr T noise = 16 * std::numeric_limits<T>::epsilon();
  return {axis, std::sqrt(chord2) * T(1.001) + noise};
}

/// The spheres that a pixel may show, out of those of its part: found when a ray asks for them, and
/// kept for the next. A pixel of a part with hundreds shows a few of them, and its packets, each
/// within the pixel, look through these alone.
template <typename T>
class PixelSpheres {
 public:
  /// `found` is memory for them.
  HWY_INLINE PixelSpheres(const SimdScene<T>& scene, const PartContents<T>& part,
                          const PixelCone<T>& cone, std::vector<ScreenEntry>& found)
      : scene_(scene), part_(part), cone_(cone), found_(found) {
    found_.clear();
  }

  /// As PartContents::for_each_sphere().
  template <class Sees, class Visit>
  HWY_INLINE void for_each(const Sees& sees, const Visit& visit) {
    const auto& entries = part_.block.spheres.entries;
    for (std::size_t i = 0;; ++i) {
      while (i == found_.size()) {
        if (looked_through_ >= entries.size() || !sees(entries[looked_through_].nearest)) return;
        find_more();
      }
      const ScreenEntry entry = found_[i];
      if (!sees(entry.nearest)) return;
      visit(entry.primitive);
    }
  }

 private:
  HWY_NOINLINE void find_more() {
    const BlockEntries& spheres = part_.block.spheres;
    part_.block.fetch_spheres(looked_through_);
    for (std::uint64_t here = entries_in_part(spheres, part_.part, looked_through_); here != 0;
         here &= here - 1) {
      const ScreenEntry& entry =
          spheres.entries[looked_through_ + hwy::Num0BitsBelowLS1Bit_Nonzero64(here)];
      if (cone_.may_meet(scene_.primitives.row(entry.primitive))) found_.push_back(entry);
    }
    looked_through_ += entries_at_once;
  }

  const SimdScene<T>& scene_;
  PartContents<T> part_;
  PixelCone<T> cone_;
  std::vector<ScreenEntry>& found_;
  std::size_t looked_through_ = 0;  ///< of the block's entries
};

/// What rays through one pixel may meet.
template <typename T>
struct PixelContents {
  const PartContents<T>& part;
  PixelSpheres<T>& spheres;

  /// As those of PartContents.
  template <class Sees, class Visit>
  HWY_INLINE void for_each_sphere(const Sees& sees, const Visit& visit) const {
    spheres.for_each(sees, visit);
  }
  template <class Sees, class Visit>
  HWY_INLINE void for_each_triangle(const Sees& sees, const Visit& visit) const {
    part.for_each_triangle(sees, visit);
  }
  HWY_INLINE bool may_show_square() const { return part.may_show_square(); }
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

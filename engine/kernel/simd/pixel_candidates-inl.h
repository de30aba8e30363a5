// Candidates of rays from the eye through one pixel.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// A cone that holds all rays from the eye through a pixel.
template <typename T>
struct PixelCone {
  Triple<T> axis;  ///< unit
  T spread;        ///< how far unit vectors in it are from the axis, at most, and a little more
};

/// Around the pixel whose lower left corner is (x, y), y = 0 at the bottom. Its corners are
/// farthest from the axis: the pixel is convex, and so is what a cone of less than a right angle
/// cuts out of the image.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE PixelCone<T> cone_around(D d, const EyeRays<D>& eye, double x, double y) {
  const auto through = [&](double right, double up) HWY_ATTR {
    const auto zero = hn::Zero(d);
    const auto direction = eye.direction(d, {x + right, y + up, zero, zero});
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

/// Memory for what a pixel's candidates are, kind by kind.
using NarrowedEntries = std::array<std::vector<ScreenEntry>, ObjectKinds::count>;

/// What a pixel may show, out of what its subtile may: found when a ray asks for it, and kept for
/// the next. A pixel of a subtile with hundreds of primitives shows a few of them, and its packets,
/// each within the pixel, look through these alone. Kinds without a HasConeTest are taken as they
/// are.
template <typename T>
class PixelCandidates {
 public:
  HWY_INLINE PixelCandidates(const SubtileCandidates<T>& subtile, const PixelCone<T>& cone,
                             NarrowedEntries& found)
      : subtile_(subtile), cone_(cone), found_(found) {
    for (std::vector<ScreenEntry>& entries : found_) entries.clear();
  }

  /// As SubtileCandidates::for_each().
  template <class Kind, class Sees, class Visit>
  HWY_INLINE void for_each(const Sees& sees, const Visit& visit) {
    if constexpr (!HasConeTest<Kind>) {
      subtile_.template for_each<Kind>(sees, visit);
    } else {
      const auto& entries = subtile_.block.entries[kind_index<Kind>].entries;
      std::vector<ScreenEntry>& found = found_[kind_index<Kind>];
      const std::size_t& looked_through = looked_through_[kind_index<Kind>];
      for (std::size_t i = 0;; ++i) {
        while (i == found.size()) {
          if (looked_through >= entries.size() || !sees(entries[looked_through].nearest)) return;
          find_more<Kind>();
        }
        const ScreenEntry entry = found[i];
        if (!sees(entry.nearest)) return;
        visit(entry.primitive);
      }
    }
  }
  template <class Kind>
  HWY_INLINE bool may_contain() const {
    return subtile_.template may_contain<Kind>();
  }

 private:
  template <class Kind>
  HWY_NOINLINE void find_more() {
    const BlockEntries& block = subtile_.block.entries[kind_index<Kind>];
    const PacketScene<T>& scene = subtile_.block.scene;
    std::size_t& looked_through = looked_through_[kind_index<Kind>];
    subtile_.block.template prefetch<Kind>(looked_through);
    for (std::uint64_t here = entries_in_subtile(block, subtile_.subtile, looked_through);
         here != 0; here &= here - 1) {
      const ScreenEntry& entry =
          block.entries[looked_through + hwy::Num0BitsBelowLS1Bit_Nonzero64(here)];
      if (may_intersect(scene.primitives, std::get<kind_index<Kind>>(scene.geometry.kinds),
                        entry.primitive, cone_.axis, cone_.spread))
        found_[kind_index<Kind>].push_back(entry);
    }
    looked_through += entries_at_once;
  }

  SubtileCandidates<T> subtile_;
  PixelCone<T> cone_;
  NarrowedEntries& found_;
  std::array<std::size_t, ObjectKinds::count> looked_through_{};  ///< of the block's entries
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

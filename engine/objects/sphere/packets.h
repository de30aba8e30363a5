// Spheres as packets of rays read them.
//
// Everything that needs more than a kernel's precision (differences of coordinates, the constant C
// of each sphere as the eye sees it) is computed once, in double.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/finders/light_grid.h"
#include "engine/finders/point_grid.h"
#include "engine/finders/swept_points.h"
#include "engine/lights/light_kind.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"
#include "engine/objects/sphere/sphere.h"

namespace raytracer {

template <typename T>
struct SphereItem {
  Triple<T> center;
  T radius2;
  T id;  ///< numbers of primitives are kept as T: they are small
  T eye_power;
  bool has_wide;  ///< whether it is, as is_wide() says
};

/// Up to eight spheres. Those that are not there have nothing that meets them.
template <typename T>
struct alignas(64) SphereBlock {
  BlockColumn<T> x, y, z;
  BlockColumn<T> radius2;
  BlockColumn<T> id;
  BlockColumn<T> eye_power;
  std::uint32_t count;
  bool has_wide;  ///< one of them, as is_wide() says

  static SphereBlock empty() {
    SphereBlock block{};
    block.radius2.fill(-1);  // no square is less
    return block;
  }
};

/// As a distant light sees it: a disc.
template <typename T>
struct SphereDisc {
  T u;
  T v;
  T w;  ///< how far the centre is towards the light
  T radius2;
  T id;

  enum Column : std::size_t { column_u, column_v, column_w, column_radius2, column_id };
  static constexpr Members<SphereDisc, T, 5> members{&SphereDisc::u, &SphereDisc::v, &SphereDisc::w,
                                                     &SphereDisc::radius2, &SphereDisc::id};
};

/// As a point light sees it.
template <typename T>
struct SphereBall {
  T x;  ///< relative to the light, or to the eye if the light is far
  T y;
  T z;
  T radius2;
  T nearest;  ///< least distance of the surface from the light, negative around it
  T id;

  enum Column : std::size_t {
    column_x,
    column_y,
    column_z,
    column_radius2,
    column_nearest,
    column_id
  };
  static constexpr Members<SphereBall, T, 6> members{&SphereBall::x,       &SphereBall::y,
                                                     &SphereBall::z,       &SphereBall::radius2,
                                                     &SphereBall::nearest, &SphereBall::id};
};

/// All of them in columns, those near each other in a block.
template <typename T>
struct SphereColumns {
  static constexpr std::size_t in_block = 64;
  enum Column : std::size_t {
    column_x,
    column_y,
    column_z,
    column_radius,
    column_radius2,
    column_id,
    column_count
  };
  std::array<LargeArray<T>, column_count> values;
  SweptBox<T> box;
  std::vector<SweptBox<T>> blocks;  ///< around each
};

/// All spheres as one light sees them; where they are tried one by one, in a single cell.
template <typename T>
struct SphereLightView {
  CasterGrid<SphereDisc<T>, T> discs;  ///< of a distant light
  PointGrid<SphereBall<T>, T> balls;   ///< of a point light
  bool is_far = false;                 ///< a point light: balls are relative to the eye

  std::size_t bytes() const { return sizeof(T) * discs.casters.values.size(); }
};

/// The square of what a tangent from the eye is long; negative inside.
inline double eye_power(const PackedSphere& s) {
  const double distance = length(s.center);
  return (distance - s.radius) * (distance + s.radius);
}

inline ShadowExtent shadow_extent(const PackedSphere& s, const LightAxes& axes) {
  const double u = dot(s.center, axes[0]);
  const double v = dot(s.center, axes[1]);
  return {u - s.radius, v - s.radius, u + s.radius, v + s.radius,
          dot(s.center, axes[2]) + s.radius};
}

template <typename T>
struct PacketLayout<SphereKind, T> : DefaultLayout {
  using Item = SphereItem<T>;
  using Block = SphereBlock<T>;
  using LightView = SphereLightView<T>;
  using Swept = SphereColumns<T>;

  static constexpr bool bins_name_rows = true;
  static bool needs_items(const FinderRow& finders) {
    return finder_of(finders, RayKind::followed) == Finder::one_by_one;
  }

  static PrimitiveRow<T> row(const PackedSphere& s, std::size_t /*item*/) {
    return {.place = narrowed<T>(s.center),
            .curvature = finite<T>(1 / s.radius),
            .radius_square = finite<T>(s.radius * s.radius),
            .eye_power = static_cast<T>(eye_power(s))};
  }
  static Item item(const PackedSphere& s, std::int32_t number) {
    return {narrowed<T>(s.center), static_cast<T>(s.radius * s.radius), static_cast<T>(number),
            static_cast<T>(eye_power(s)), is_wide(s)};
  }
  static void fill(const PackedSphere& s, std::int32_t number, std::size_t place, Block& block) {
    block.x[place] = static_cast<T>(s.center.x);
    block.y[place] = static_cast<T>(s.center.y);
    block.z[place] = static_cast<T>(s.center.z);
    block.radius2[place] = static_cast<T>(s.radius * s.radius);
    block.id[place] = static_cast<T>(number);
    block.eye_power[place] = static_cast<T>(eye_power(s));
    block.has_wide = block.has_wide || is_wide(s);
  }
  static Swept swept(std::span<const PackedSphere> spheres, const Numbering& numbers,
                     WorkerPool& pool);
  static LightView light_view(std::span<const PackedSphere> spheres, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers, WorkerPool& pool);
};

extern template struct PacketLayout<SphereKind, float>;
extern template struct PacketLayout<SphereKind, double>;

}  // namespace raytracer

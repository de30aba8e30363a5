// Cylinders as packets of rays read them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/finders/light_grid.h"
#include "engine/lights/light_kind.h"
#include "engine/memory/page_allocator.h"
#include "engine/objects/cylinder/cylinder.h"
#include "engine/objects/lamp_view.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"

namespace raytracer {

/// In axes of its own. The axis is turned so that the eye, if it is beyond an end, is beyond `low`.
template <typename T>
struct CylinderItem {
  Triple<T> across;   ///< unit, at right angles to the other two
  Triple<T> towards;  ///< unit, from the eye to the foot
  Triple<T> axis;     ///< unit
  T distance;         ///< of the foot
  T radius2;
  T eye_c;  ///< distance^2 - radius^2, from twice the precision of a double
  T low;    ///< the ends, along the axis from the foot
  T high;
  T has_caps;  ///< 0 or 1
  T id;
};

/// Up to eight cylinders. Those that are not there have nothing that meets them.
template <typename T>
struct alignas(64) CylinderBlock {
  std::array<BlockColumn<T>, 9> axes;  ///< x, y, z of across, of towards and of axis
  BlockColumn<T> distance, radius2, low, high, has_caps, id;
  std::uint32_t count;

  static CylinderBlock empty() {
    CylinderBlock block{};
    block.radius2.fill(-1);  // no square is less
    return block;
  }
};

/// A closed cylinder's shadow under a distant light: what does not depend on the point.
template <typename T>
struct CylinderShadow {
  Triple<T> k;    ///< across axis and light
  Triple<T> e;    ///< across the axis, along the light
  Triple<T> w;    ///< the axis
  T x, b, along;  ///< of the foot, along these
  T radius2;
  T per_e, per_w;  ///< 1 / the light's part along e and w
  T low, high;
};

template <typename T>
struct CylinderLightView {
  ListGrid<T> grid;                       ///< of a distant light, where there are many
  LargeArray<CylinderShadow<T>> shadows;  ///< of a distant light
  LampView<CylinderItem<T>, T> lamp;      ///< of a point light
};

/// The planes through the eye that touch the endless cylinder; all of the image from within it.
std::array<Line, 2> screen_outline(const View& view, const PackedCylinder& cylinder);

ShadowExtent shadow_extent(const PackedCylinder& cylinder, const LightAxes& axes);

template <typename T>
struct PacketLayout<CylinderKind, T> : DefaultLayout {
  using Item = CylinderItem<T>;
  using Block = CylinderBlock<T>;
  using LightView = CylinderLightView<T>;

  static PrimitiveRow<T> row(const PackedCylinder&, std::size_t item) {
    return {.place = {}, .curvature = PrimitiveRow<T>::own_normal, .item = static_cast<T>(item)};
  }
  static Item item(const PackedCylinder& cylinder, std::int32_t number);
  static void fill(const PackedCylinder& cylinder, std::int32_t number, std::size_t place,
                   Block& block);
  static LightView light_view(std::span<const PackedCylinder> cylinders, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers, WorkerPool& pool);
};

extern template struct PacketLayout<CylinderKind, float>;
extern template struct PacketLayout<CylinderKind, double>;

}  // namespace raytracer

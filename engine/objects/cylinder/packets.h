// Cylinders as packets of rays read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/memory/page_allocator.h"
#include "engine/objects/axial_packets.h"
#include "engine/objects/cylinder/cylinder.h"

namespace raytracer {

template <typename T>
struct CylinderItem : AxialItem<T> {
  T radius2;
};

/// Up to eight cylinders. Those that are not there have nothing that meets them.
template <typename T>
struct CylinderBlock : AxialBlock<T> {
  BlockColumn<T> radius2;
  std::uint32_t count;

  static CylinderBlock empty() {
    CylinderBlock block{};
    block.radius2.fill(-1);  // no square is less
    return block;
  }
  void put(const CylinderItem<T>& c, std::size_t place) {
    AxialBlock<T>::put(c, place);
    radius2[place] = c.radius2;
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
struct CylinderLightView : AxialLightView<CylinderItem<T>, T> {
  LargeArray<CylinderShadow<T>> shadows;  ///< of a distant light
};

/// The planes through the eye that touch the endless cylinder; all of the image from within it.
std::array<Line, 2> screen_outline(const View& view, const PackedCylinder& cylinder);

template <typename T>
struct PacketLayout<CylinderKind, T>
    : AxialLayout<CylinderKind, T, CylinderItem<T>, CylinderBlock<T>> {
  using LightView = CylinderLightView<T>;

  static CylinderItem<T> item(const PackedCylinder& cylinder, std::int32_t number);
  static LightView light_view(std::span<const PackedCylinder> cylinders, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers, WorkerPool& pool);
};

extern template struct PacketLayout<CylinderKind, float>;
extern template struct PacketLayout<CylinderKind, double>;

}  // namespace raytracer

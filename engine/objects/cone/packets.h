// Cones as packets of rays read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/objects/axial_packets.h"
#include "engine/objects/cone/cone.h"

namespace raytracer {

/// The axes across the axis are times the cosine, so that they give what |F| is made of.
template <typename T>
struct ConeItem : AxialItem<T> {
  T sine;        ///< what the girth grows by along the axis
  T girth;       ///< at the foot
  T low_girth2;  ///< of the girths at the ends the squares
  T high_girth2;
};

/// Up to eight cones. Those that are not there have nothing that meets them.
template <typename T>
struct ConeBlock : AxialBlock<T> {
  BlockColumn<T> sine, girth, low_girth2, high_girth2;
  std::uint32_t count;

  static ConeBlock empty() { return {}; }  // no square is less than a girth of 0
  void put(const ConeItem<T>& c, std::size_t place) {
    AxialBlock<T>::put(c, place);
    sine[place] = c.sine;
    girth[place] = c.girth;
    low_girth2[place] = c.low_girth2;
    high_girth2[place] = c.high_girth2;
  }
};

/// The planes through the eye that touch the endless cone; all of the image where there are none.
std::array<Line, 2> screen_outline(const View& view, const PackedCone& cone);

template <typename T>
struct PacketLayout<ConeKind, T> : AxialLayout<ConeKind, T, ConeItem<T>, ConeBlock<T>> {
  static ConeItem<T> item(const PackedCone& cone, std::int32_t number);
};

extern template struct PacketLayout<ConeKind, float>;
extern template struct PacketLayout<ConeKind, double>;

}  // namespace raytracer

// Cones as packets of rays read them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/finders/light_grid.h"
#include "engine/lights/light_kind.h"
#include "engine/memory/page_allocator.h"
#include "engine/objects/cone/cone.h"
#include "engine/objects/lamp_view.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"

namespace raytracer {

/// In axes of its own, those across the axis times the cosine, so that they give what |F| is made
/// of. The axis is turned so that the eye, if it is beyond an end, is beyond `low`.
template <typename T>
struct ConeItem {
  Triple<T> across;   ///< at right angles to the other two
  Triple<T> towards;  ///< from the eye to the foot
  Triple<T> axis;     ///< unit
  T distance;         ///< of the foot, times the cosine
  T sine;             ///< what the girth grows by along the axis
  T girth;            ///< at the foot
  T low;              ///< the ends, along the axis from the foot
  T high;
  T low_girth2;  ///< of the girths there the squares
  T high_girth2;
  T has_caps;  ///< 0 or 1
  T id;
  T eye_c;  ///< PackedCone's
};

/// Up to eight cones. Those that are not there have nothing that meets them.
template <typename T>
struct alignas(64) ConeBlock {
  std::array<BlockColumn<T>, 9> axes;  ///< x, y, z of across, of towards and of axis
  BlockColumn<T> distance, sine, girth, low, high, low_girth2, high_girth2, has_caps, id;
  std::uint32_t count;

  static ConeBlock empty() { return {}; }  // no square is less than a girth of 0
};

template <typename T>
struct ConeLightView {
  ListGrid<T> grid;               ///< of a distant light, where there are many
  LampView<ConeItem<T>, T> lamp;  ///< of a point light
};

/// The planes through the eye that touch the endless cone; all of the image where there are none.
std::array<Line, 2> screen_outline(const View& view, const PackedCone& cone);

ShadowExtent shadow_extent(const PackedCone& cone, const LightAxes& axes);

template <typename T>
struct PacketLayout<ConeKind, T> : DefaultLayout {
  using Item = ConeItem<T>;
  using Block = ConeBlock<T>;
  using LightView = ConeLightView<T>;

  static PrimitiveRow<T> row(const PackedCone&, std::size_t item) {
    return {.place = {}, .curvature = PrimitiveRow<T>::own_normal, .item = static_cast<T>(item)};
  }
  static Item item(const PackedCone& cone, std::int32_t number);
  static void fill(const PackedCone& cone, std::int32_t number, std::size_t place, Block& block);
  static LightView light_view(std::span<const PackedCone> cones, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers, WorkerPool& pool);
};

extern template struct PacketLayout<ConeKind, float>;
extern template struct PacketLayout<ConeKind, double>;

}  // namespace raytracer

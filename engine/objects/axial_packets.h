// Surfaces of revolution between the ends of an axis as packets of rays read them. A kind adds the
// numbers of its side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/finders/light_grid.h"
#include "engine/lights/light_kind.h"
#include "engine/objects/axial.h"
#include "engine/objects/lamp_view.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"

namespace raytracer {

/// In axes of its own, of which a kind may take a share across the axis. The axis is turned so that
/// the eye, if it is beyond an end, is beyond `low`.
template <typename T>
struct AxialItem {
  Triple<T> across;   ///< at right angles to the other two
  Triple<T> towards;  ///< from the eye to the foot
  Triple<T> axis;     ///< unit
  T distance;         ///< of the foot, by the same share
  T low;              ///< the ends, along the axis from the foot
  T high;
  T has_caps;  ///< 0 or 1
  T id;
  T eye_power;  ///< AxialSolid's

  static AxialItem of(const AxialSolid& c, const AxisBasis& own, std::int32_t number,
                      double share = 1) {
    return {narrowed<T>(share * own.across),
            narrowed<T>(share * own.towards),
            narrowed<T>(own.axis),
            static_cast<T>(share * length(c.foot)),
            static_cast<T>(own.is_turned ? -c.high : c.low),
            static_cast<T>(own.is_turned ? -c.low : c.high),
            static_cast<T>(c.has_caps),
            static_cast<T>(number),
            static_cast<T>(c.eye_power)};
  }
};

/// Up to eight of them, which a kind counts.
template <typename T>
struct alignas(64) AxialBlock {
  std::array<BlockColumn<T>, 9> axes;  ///< x, y, z of across, of towards and of axis
  BlockColumn<T> distance, low, high, has_caps, id;

  void put(const AxialItem<T>& c, std::size_t place) {
    const std::array<T, 9> values{c.across.x,  c.across.y, c.across.z, c.towards.x, c.towards.y,
                                  c.towards.z, c.axis.x,   c.axis.y,   c.axis.z};
    for (std::size_t i = 0; i < values.size(); ++i) axes[i][place] = values[i];
    distance[place] = c.distance;
    low[place] = c.low;
    high[place] = c.high;
    has_caps[place] = c.has_caps;
    id[place] = c.id;
  }
};

template <typename Item, typename T>
struct AxialLightView {
  ListGrid<T> grid;        ///< of a distant light, where there are many
  LampView<Item, T> lamp;  ///< of a point light
};

template <AxialPrimitive Solid>
ShadowExtent shadow_extent(const Solid& c, const LightAxes& axes) {
  Box box;
  const auto along = [&](const Vec3& axis) { return length(cross(c.axis, axis)); };
  const Vec3 reach{along(axes[0]), along(axes[1]), along(axes[2])};
  for (const bool is_to : {false, true}) {
    const Vec3 end = c.end(is_to);
    const Vec3 place{dot(end, axes[0]), dot(end, axes[1]), dot(end, axes[2])};
    const Vec3 disc = end_radius(c, is_to) * reach;
    box.include(Box{place - disc, place + disc});
  }
  return {box.low.x, box.low.y, box.high.x, box.high.y, box.high.z};
}

/// What a kind's PacketLayout begins with; the kind adds item().
template <AxialKind Kind, typename T, typename Item_, typename Block_>
struct AxialLayout : DefaultLayout {
  using Layout = PacketLayout<Kind, T>;
  using Solid = typename Kind::Primitive;
  using Item = Item_;
  using Block = Block_;
  using LightView = AxialLightView<Item, T>;

  static PrimitiveRow<T> row(const Solid&, std::size_t item) {
    return {.place = {}, .curvature = PrimitiveRow<T>::own_normal, .item = static_cast<T>(item)};
  }
  static void fill(const Solid& c, std::int32_t number, std::size_t place, Block& block) {
    block.put(Layout::item(c, number), place);
  }
  static LightView light_view(std::span<const Solid> solids, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers,
                              WorkerPool& pool) {
    if (light.rays == LightRays::converging) {
      const Finder finder = finder_of(finders, RayKind::to_point_light);
      return {{}, lamp_view<Layout, T>(solids, light.place, finder, numbers, pool)};
    }
    if (finder_of(finders, ray_kind_of(light)) != Finder::light_grid) return {};
    const auto outline_of = [axes = light_axes(light.place), solids](std::size_t i) {
      const Solid& c = solids[i];
      return strip_outline(axes, c.foot, c.axis, largest_radius(c));
    };
    return {build_list_grid<T>(light.place, solids, outline_of, pool), {}};
  }
};

}  // namespace raytracer

// Planes as packets of rays read them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/lights/light_kind.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"
#include "engine/objects/plane/plane.h"
#include "engine/packets/flat_layout.h"

namespace raytracer {

/// All planes as one light sees them.
template <typename T>
struct PlaneLightView {
  std::vector<T> sides;  ///< of a point light: of each plane 1 or -1, 0 if the light is in it
};

template <typename T>
struct PacketLayout<PlaneKind, T> : DefaultLayout {
  using Item = FlatItem<T>;
  using LightView = PlaneLightView<T>;

  static PrimitiveRow<T> row(const PackedPlane& p, std::size_t /*item*/) {
    return flat_row<T>(p.normal, p.point);
  }
  static Item item(const PackedPlane& p, std::int32_t number) {
    return flat_item<T>(p.normal, p.point, number);
  }
  static LightView light_view(std::span<const PackedPlane> planes, const PackedLight& light,
                              const FinderRow&, const Numbering&, WorkerPool&) {
    LightView view;
    if (light.rays == LightRays::converging)
      for (const PackedPlane& plane : planes) view.sides.push_back(side_of(light.place, plane));
    return view;
  }

 private:
  /// By its exact height over the plane: from what T holds of a plane near the eye that of a light
  /// far away is rounding alone.
  static T side_of(const Vec3& light, const PackedPlane& plane) {
    constexpr double noise = 64 * std::numeric_limits<double>::epsilon();
    const double height = dot(plane.normal, light - plane.point);
    if (std::abs(height) <= noise * (max_abs(light) + max_abs(plane.point))) return 0;
    return height > 0 ? T(1) : T(-1);
  }
};

}  // namespace raytracer

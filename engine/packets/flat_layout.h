// What is flat, as packets of rays read it.
#pragma once

#include <cstdint>

#include "engine/packets/primitive_row.h"

namespace raytracer {

/// A plane, or that of something flat.
template <typename T>
struct FlatItem {
  Triple<T> normal;  ///< unit
  T height;          ///< normal . (point - eye)
  T id;
};

/// The plane through `point`.
template <typename T>
FlatItem<T> flat_item(const Vec3& normal, const Vec3& point, std::int32_t number) {
  return {narrowed<T>(normal), static_cast<T>(dot(normal, point)), static_cast<T>(number)};
}

/// As hits need it, of the plane through `point`: no curvature.
template <typename T>
PrimitiveRow<T> flat_row(const Vec3& normal, const Vec3& point) {
  return {.place = narrowed<T>(-normal), .eye_power = static_cast<T>(dot(normal, point))};
}

}  // namespace raytracer

// Materials as packets of points read them, in their own precision.
#pragma once

#include "engine/materials/integer_exponents.h"
#include "engine/materials/materials.h"
#include "engine/math/triple.h"
#include "engine/memory/page_allocator.h"

namespace raytracer {

/// Of one material. All members are T, so that a packet can gather one of many rows.
template <typename T>
struct MaterialRow {
  Triple<T> color;
  T ambient;  ///< ka times the scene's
  T kd;
  T ks;
  T shininess;
  T reflectivity;

  static MaterialRow of(const Material& m, double scene_ambient) {
    return {{finite<T>(m.color.x), finite<T>(m.color.y), finite<T>(m.color.z)},
            saturated<T>(m.ka * scene_ambient),
            finite<T>(m.kd),
            finite<T>(m.ks),
            finite<T>(m.shininess),
            finite<T>(m.reflectivity)};
  }
};

/// What lets rays through, of one material.
template <typename T>
struct GlassRow {
  T transparency;
  T ior;
  T fresnel;  ///< 0 or 1
  T unused{};

  static GlassRow of(const Material& m) {
    return {finite<T>(m.transparency), finite<T>(m.ior), m.fresnel ? T(1) : T(0)};
  }
};

/// The scene's, and what they have in common.
template <typename T>
struct PacketMaterials {
  LargeArray<MaterialRow<T>> rows;
  LargeArray<GlassRow<T>> glass;  ///< likewise, if any lets rays through
  bool has_specular = false;
  IntegerExponents integer_shininess{};  ///< of all specular ones
};

}  // namespace raytracer

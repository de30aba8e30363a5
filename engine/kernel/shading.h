// Light at a point, and Blinn's version of Phong's reflection (Blinn: "Models of light reflection
// for computer synthesized pictures", SIGGRAPH 1977).
#pragma once

#include "engine/math/ray.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

/// A light as a point sees it.
struct Illumination {
  Vec3 towards;     ///< unit; zero where the light is exactly at the point
  double distance;  ///< infinite for a distant light
  Rgb intensity;    ///< that arrives; finite
};

Illumination illuminate(const PackedLight& light, const Departure& point);

/// color * (kd (N.L) + ks max(0, H.N)^shininess) * i, for N.L > 0; all vectors are unit.
Rgb direct_light(const Material& material, const Illumination& light, const Vec3& normal,
                 const Vec3& view);

}  // namespace raytracer

// What of shading and geometry a scene needs: only what a pixel can show counts.
//
// A material counts if something is made of it, a light if it can change a colour, a reflection if
// a ray may be reflected at all. What is absent here, no kernel needs to do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/lights/lights.h"
#include "engine/materials/integer_exponents.h"
#include "engine/objects/objects.h"

namespace raytracer {

struct Scene;

struct Features {
  std::array<std::size_t, ObjectKinds::count> primitives{};  ///< of each kind
  std::size_t materials = 0;                                 ///< of at least one of them

  /// Of each kind, those that can change a colour. One without emission does so where shadows are
  /// black: it brings the ambient part.
  std::array<std::size_t, LightKinds::count> lights{};
  std::array<std::size_t, light_rays_count> lights_by_rays{};  ///< the same
  std::size_t soft_lights = 0;                                 ///< of them
  std::size_t shared_lights = 0;       ///< soft ones, to which rays share directions
  bool casts_shadows = false;          ///< a light's visibility has to be found out
  bool has_ambient = false;            ///< some surface shows an ambient part
  bool has_diffuse = false;            ///< some surface has kd > 0 under a light that emits
  bool has_specular = false;           ///< some surface has ks > 0 under a light that emits
  double shininess = 0;                ///< the largest in use; 0 if nothing is specular
  IntegerExponents integer_shininess;  ///< of all specular materials in use

  bool has_corner_normals = false;  ///< interpolated between corners, for smooth shading
  bool has_corner_colors = false;   ///< likewise

  bool reflects = false;    ///< some surface mirrors and a ray may be reflected at least once
  double reflectivity = 0;  ///< the largest in use; 0 if nothing reflects
  bool transmits = false;   ///< some surface lets light through
  double transparency = 0;  ///< the largest in use
  double ior = 1;           ///< the largest of what lets light through
  /// Kinds of which some lets light through.
  std::array<bool, ObjectKinds::count> transmitting{};
  int max_depth = 0;  ///< rays that follow another in a row; 0 if none does

  std::size_t primitive_count() const;
  std::size_t light_count() const;
  /// Of lights whose rays share that.
  std::size_t light_count(LightRays rays) const;
};

/// The lights that can change a colour, in order.
std::vector<Light> lights_in_use(const Scene& scene);

Features find_features(const Scene& scene);

}  // namespace raytracer

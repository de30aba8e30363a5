// Which structures over its primitives a scene's rays need, and by which of them each kind of ray
// finds each kind of object.
//
// Rays that share an origin or a direction need a 2-D structure only; a tree is for those that
// share neither, and for what would fill such a structure too often. Nothing is built that no ray
// asks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/plan/census.h"
#include "engine/plan/features.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Which code traces the scene.
enum class Kernel : std::uint8_t {
  simd,         ///< packets of rays, of everything that is seen from outside
  brute_force,  ///< the reference: one ray at a time against everything
  bvh,          ///< the reference's arithmetic with a tree over spheres and triangles
};

struct Structures {
  bool sphere_bins = false;  ///< on the screen, for rays from the eye; else by the tree
  bool light_grids = false;  ///< over the spheres, for each light
  bool sphere_tree = false;
  bool each_sphere = false;     ///< tried by rays but those from the eye, where there are few; to
                                ///< point lights as LitSphere
  bool triangle_bins = false;   ///< on the screen, for rays from the eye; else by the tree
  bool triangle_grids = false;  ///< for each distant light; else by the tree
  bool triangle_tree = false;
};

/// The least sine of a distant light's elevation over a square at which a list of neighbours finds
/// what shadows its spheres; below (about 3.4 degrees) the list grows long, and a walk takes over.
inline constexpr double lowest_stencil_slope = 0.06;

Structures choose_structures(const Features& features, const Census& census);

/// How one kind of ray finds one kind of object.
struct Way {
  std::string objects;    ///< "1,000 spheres"
  std::string rays;       ///< "from the eye", "to 2 distant lights", "reflected"
  std::string structure;  ///< "a grid for each light"
  std::string reason;
};

/// All ways that the scene's rays take through its objects.
std::vector<Way> explain_ways(const Scene& scene, const Features& features, Kernel kernel,
                              const Structures& structures);

}  // namespace raytracer

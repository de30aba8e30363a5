// Which structures over its primitives a scene's rays need, besides the screen's bins of spheres.
#pragma once

namespace raytracer {

struct Structures {
  bool light_grids = false;  ///< over the spheres, for each light
  bool sphere_tree = false;
  bool triangle_bins = false;   ///< on the screen, for rays from the eye; else by the tree
  bool triangle_grids = false;  ///< for each distant light; else by the tree
  bool triangle_tree = false;
};

}  // namespace raytracer

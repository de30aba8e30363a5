// Which structures over its primitives a scene's rays need, besides the screen's bins.
#pragma once

namespace raytracer {

struct Structures {
  bool light_grids = false;  ///< over the spheres, for each light: all must be distant
  bool sphere_tree = false;
  bool triangle_tree = false;
};

}  // namespace raytracer

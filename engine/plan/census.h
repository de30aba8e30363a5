// How near, far and large the things of a scene are: what the choice of precision rests on.
#pragma once

#include <limits>

#include "engine/parallel/worker_pool.h"
#include "engine/plan/features.h"
#include "engine/plan/frame.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Lengths are in frame coordinates, distances from the eye.
struct Census {
  // About how many blocks of 16 x 16 pixels each sphere and each triangle touches, in sum; rather
  // too many.
  double sphere_blocks = 0;
  double triangle_blocks = 0;
  double nearest = std::numeric_limits<double>::infinity();  ///< surface; 0 inside a sphere
  /// Distance from the eye to the nearest surface, on whichever side of it the eye is.
  double clearance = std::numeric_limits<double>::infinity();
  double farthest = 0;           ///< point of a sphere, square or mesh, and point light
  double distance_in_radii = 0;  ///< the largest of farthest distance / radius
  double shadow_path = 0;        ///< no occluder stands farther than this from what it shadows
  /// How many times as far from a point light the farthest thing in view may be as the nearest
  /// triangle or square: so much wider a shadow can be than its occluder. A plane is in view up to
  /// a sixteenth of a pixel below its horizon.
  double shadow_spread = 1;
  /// The least distance of a point light to a surface, as a share of the farthest extent.
  double light_clearance = std::numeric_limits<double>::infinity();
  /// By how much a reflection can magnify an error of direction, in what it changes of a pixel: a
  /// mirroring sphere of radius r spreads neighbouring rays 2 d / r times as far at a distance d,
  /// and shows what it mirrors only as bright as its reflectivity.
  double magnification = 1;
  double gap = std::numeric_limits<double>::infinity();  ///< as least_gap() says
  double coarseness = 0;  ///< the largest step between a centre's doubles, in radii of its sphere
  double small_spheres = 0;        ///< that may be seen smaller than a pixel, ...
  bool has_small_squares = false;  ///< ... and whether squares of them are among these
  /// Radius, or coordinate that a triangle reaches to, of those that the frame carries.
  double smallest = std::numeric_limits<double>::infinity();
  double lost = 0;         ///< spheres, squares and triangles that the frame cannot carry
  double brightest = 0;    ///< i of a light where it is nearest to a surface, any channel
  double pixel_angle = 0;  ///< radians, at the image's centre
};

/// `pool`: whose threads help with many spheres, if there is one; the result is the same.
Census take_census(const Scene& scene, const Frame& frame, const Features& features,
                   WorkerPool* pool = nullptr);

}  // namespace raytracer

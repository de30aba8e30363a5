// What plans ask of objects of any kind: how near, far and large they are, as seen from a point.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/math/block.h"
#include "engine/math/tolerances.h"
#include "engine/math/vec.h"
#include "engine/math/view.h"

namespace raytracer {

/// From where objects are looked at: the eye, or a point light. In frame coordinates.
struct Viewpoint {
  Vec3 place;
  Vec3 scene_origin;   ///< of the scene's coordinates
  View view;           ///< the eye's
  double pixel_angle;  ///< radians, at the image's centre
  double blocks_per_radian;
  double block_columns;  ///< of the image
  double block_rows;

  /// Blocks that something touches which is seen under twice this angle; its tangent.
  double blocks(double half_angle) const {
    const double across = 2 * half_angle * blocks_per_radian + 1;
    return std::min(across, block_columns) * std::min(across, block_rows);
  }

  /// `view` and `scene_origin` are the eye's.
  static Viewpoint at(const Vec3& place, const View& view, const Vec3& scene_origin) {
    const double half_width = length(view.right) / length(view.forward);
    const double half_height = length(view.up) / length(view.forward);
    const double angle = 2 * half_width / view.width;
    // By how much larger a thing is in the image's corner than in its middle.
    const double stretch = 1 + half_width * half_width + half_height * half_height;
    return {place,
            scene_origin,
            view,
            angle,
            stretch / (block_side * angle),
            1 + static_cast<double>(view.width) / block_side,
            1 + static_cast<double>(view.height) / block_side};
  }
};

/// Of primitives of one kind or of several. Lengths are in frame coordinates, distances from the
/// viewpoint.
struct GeometryStatistics {
  double nearest = infinity;  ///< surface; negative inside of it
  /// Distance to the nearest surface, on whichever side of it the viewpoint is.
  double clearance = infinity;
  double farthest = 0;  ///< point of anything bounded
  /// How large the numbers are from which the place is computed where rays that start near the
  /// viewpoint meet one; 0 of kinds that do not tell: no larger than the farthest point is away.
  double meeting = 0;
  double visible_reach = 0;  ///< of what is unbounded: how far its points are in view
  /// The least sine of half the angle that something round is seen at: a radius over the distance
  /// of its centre.
  double least_sine = infinity;
  /// Radius, or coordinate that a primitive without one reaches to.
  double smallest = infinity;
  double place_in_radii = 0;  ///< the largest coordinate of a centre in the scene, in radii
  double blocks = 0;  ///< of 16 x 16 pixels that each primitive touches, in sum; rather more
  double block_distances = 0;         ///< of the primitive in each of these, in sum
  double subpixel = 0;                ///< round things that may be seen smaller than a pixel ...
  double parts = 0;                   ///< of lattices: the round things that they are made of
  bool has_subpixel_lattice = false;  ///< ... and whether they stand in a regular pattern

  void note_surface(double distance) {
    nearest = std::min(nearest, distance);
    clearance = std::min(clearance, std::abs(distance));
  }

  void note_meeting(double size) { meeting = std::max(meeting, size); }

  /// Of something so far away, negative inside of it, that touches so many.
  void note_blocks(double count, double distance) {
    blocks += count;
    block_distances += count * std::max(distance, 0.0);
  }

  /// Of a round thing whose middle has that place in the scene.
  void note_place(const Vec3& place, double radius) {
    const double largest = max_abs(place);
    // A division takes as long as all else that is done with a sphere: most need none here.
    if (largest > place_in_radii * radius) place_in_radii = largest / radius;
  }

  void include(const GeometryStatistics& other) {
    nearest = std::min(nearest, other.nearest);
    clearance = std::min(clearance, other.clearance);
    farthest = std::max(farthest, other.farthest);
    meeting = std::max(meeting, other.meeting);
    visible_reach = std::max(visible_reach, other.visible_reach);
    least_sine = std::min(least_sine, other.least_sine);
    smallest = std::min(smallest, other.smallest);
    place_in_radii = std::max(place_in_radii, other.place_in_radii);
    blocks += other.blocks;
    block_distances += other.block_distances;
    subpixel += other.subpixel;
    parts += other.parts;
    has_subpixel_lattice = has_subpixel_lattice || other.has_subpixel_lattice;
  }

  /// The largest of farthest distance / radius of something round: what its normals' errors grow
  /// by.
  double distance_in_radii() const { return std::isinf(least_sine) ? 0 : 1 + 1 / least_sine; }

  double meeting_distance() const { return meeting > 0 ? meeting : farthest; }

  /// The largest step between the doubles of a centre, in radii.
  double coarseness() const { return place_in_radii * unit_roundoff<double>; }
};

/// Curved mirrors, which magnify errors of direction.
struct CurvedMirrors {
  double count = 0;
  double smallest = infinity;  ///< radius
  double radius_sum = 0;
  Vec3 low{infinity, infinity, infinity};  ///< of the space they stand in
  Vec3 high{-infinity, -infinity, -infinity};

  /// `number` of them, within `reach` of `center`.
  void include(const Vec3& center, double radius, double number, double reach) {
    count += number;
    smallest = std::min(smallest, radius);
    radius_sum += number * radius;
    const auto widen = [reach](double place, double& least, double& most) {
      least = std::min(least, place - reach);
      most = std::max(most, place + reach);
    };
    widen(center.x, low.x, high.x);
    widen(center.y, low.y, high.y);
    widen(center.z, low.z, high.z);
  }
};

/// Where a primitive is, as a point of many dimensions: those that nearly coincide have places near
/// each other.
struct Placement {
  Vec3 place;
  Vec3 other;    ///< a second point, where a kind has two
  double size;   ///< a radius; 0 where a kind has none
  double reach;  ///< how far it is from the eye
};

}  // namespace raytracer

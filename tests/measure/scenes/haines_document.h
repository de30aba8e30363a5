// What the documents of Haines' scenes have in common.
#pragma once

#include <string>
#include <vector>

#include "engine/math/vec.h"

namespace raytracer::measure {

/// As in his files, whose space is right-handed: a document's is not, so that the scene is
/// mirrored in x, once, here.
struct HainesView {
  Vec3 from;
  Vec3 at;
};

inline Vec3 mirrored(const Vec3& point) { return {-point.x, point.y, point.z}; }

/// A material by its colour, the diffuse share, the highlight's, which is also the mirrored one,
/// the exponent and the share that is let through.
struct HainesFill {
  const char* name;
  Vec3 color;
  double kd = 1;
  double ks = 0;
  double shine = 1;
  double transmitted = 0;
  double index = 1;
};

/// 512 x 512 pixels, z upwards, an angle of 45 degrees, his blue background, lights without falloff
/// that are one over the square root of their number strong, no ambient light.
std::string haines_document(const HainesView& view, const std::vector<Vec3>& lights,
                            const std::vector<HainesFill>& fills,
                            const std::vector<std::string>& objects);

/// A square across z, of this half width, as a `mesh`.
std::string haines_floor(double half_width, double z, const std::string& material);

}  // namespace raytracer::measure

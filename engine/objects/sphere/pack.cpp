// Spheres on their way into frame coordinates, and where they throw their shadows there.
#include <algorithm>
#include <cmath>

#include "engine/objects/sphere/sphere.h"

namespace raytracer {
namespace {

bool is_too_small(const PackedSphere& sphere) { return !Frame::carries(sphere.radius); }

}  // namespace

void pack(const Sphere& s, Packing<PackedSphere>& to) {
  const PackedSphere sphere{
      to.frame.frame_from_scene(s.center), to.frame.frame_from_scene(s.radius), {to.object, 0}};
  to.add(sphere, !is_too_small(sphere));
}

void pack(const Spheres& s, Packing<PackedSphere>& to) {
  const auto make = [&](std::size_t i) {
    return PackedSphere{to.frame.frame_from_scene(s.centers[i]),
                        to.frame.frame_from_scene(s.radius(i)),
                        {to.object, i}};
  };
  to.add_all(s.centers.size(), make, is_too_small, is_too_small);
}

double shadow_edge_distance(const PackedSphere& s, const PackedLight& light) {
  // In the plane of the origin and the axis along which light meets the middle: `along` it and
  // across it, from the middle on, the edge is a ray from the touched circle on.
  Vec3 onward = -light.place;
  double touch_sine = 0;  // of the angle at which the edge leaves the axis
  if (light.rays != LightRays::parallel) {
    const Vec3 from_light = s.center - light.place;
    const double distance = length(from_light);
    if (!(distance > s.radius)) return 0;
    onward = from_light / distance;
    touch_sine = s.radius / distance;
  }
  const double touch_cosine = std::sqrt((1 - touch_sine) * (1 + touch_sine));
  const double along = -dot(s.center, onward);
  const double across = std::sqrt(std::max(0.0, dot(s.center, s.center) - along * along));
  // From where the edge begins.
  const double x = along + s.radius * touch_sine;
  const double y = across - s.radius * touch_cosine;
  const double behind = x * touch_cosine + y * touch_sine;
  const double beside = std::abs(y * touch_cosine - x * touch_sine);
  return behind > 0 ? beside : std::hypot(behind, beside);
}

}  // namespace raytracer

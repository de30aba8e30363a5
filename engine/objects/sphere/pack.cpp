// Spheres on their way into frame coordinates.
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

}  // namespace raytracer

// Planes in frame coordinates, and what the plan has to know of them: how near, far and
// large they are.
#include <algorithm>
#include <cmath>

#include "engine/objects/plane/plane.h"

namespace raytracer {

void pack(const Plane& p, Packing<PackedPlane>& to) {
  to.add({to.frame.frame_from_scene(p.point), unit(p.normal), {to.object, 0}}, true);
}

Box bounds(const PackedPlane& p) {
  Box box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  for (const int axis : {0, 1, 2}) {
    Vec3 across;
    component(across, axis) = 1;
    if (cross(p.normal, across) != Vec3{}) continue;
    component(box.low, axis) = component(box.high, axis) = component(p.point, axis);
  }
  return box;
}

void add_statistics(const PackedPlane& p, const Viewpoint& from, GeometryStatistics& to) {
  to.note_surface(std::abs(dot(p.normal, p.point - from.place)));
  // How far from the eye its points are in view. Of a corner of the image over the horizon, or
  // nearly: as far as can be told from the horizon.
  constexpr double pixels_to_horizon = 1.0 / 16;
  const double above = dot(p.normal, p.point);
  const double to_horizon = pixels_to_horizon * from.pixel_angle;
  for (const int x : {0, from.view.width})
    for (const int y : {0, from.view.height}) {
      const double slope = dot(p.normal, from.view.direction(x, y));
      const double sine = above > 0 ? slope : -slope;
      to.visible_reach = std::max(to.visible_reach, std::abs(above) / std::max(sine, to_horizon));
    }
}

bool is_grazed(const PackedPlane& plane, const PackedLight& light) {
  constexpr double told_apart = 1e-12;
  const bool is_parallel = light.rays == LightRays::parallel;
  const Vec3 along = is_parallel ? light.place : light.place - plane.point;
  if (max_abs(along) == 0) return true;
  const Vec3 cosine_terms = plane.normal * unit(along);
  const bool is_exact = is_parallel && max_abs(cosine_terms) == 0;
  return !is_exact && std::abs(cosine_terms.x + cosine_terms.y + cosine_terms.z) < told_apart;
}

std::optional<Placement> placement_of(const PackedPlane& p) {
  const double height = dot(p.normal, p.point);
  return Placement{p.normal * height, {}, 0, std::abs(height)};
}

}  // namespace raytracer

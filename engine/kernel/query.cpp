#include "engine/kernel/query.h"

#include "engine/kernel/flat.h"
#include "engine/kernel/sphere.h"
#include "engine/kernel/square.h"

namespace raytracer {
namespace {

std::optional<SphereHit> intersect(const Ray& ray, const PackedSphere& sphere) {
  const bool is_left = ray.from.surface != Departure::Surface::none && ray.from.id == sphere.id;
  return intersect_sphere(ray, sphere.center, sphere.radius, is_left);
}

}  // namespace

void NearestHit::show(const PackedSphere& sphere) {
  const auto hit = intersect(ray_, sphere);
  if (hit && is_nearer(hit->t, sphere.id))
    take_sphere(hit->t, sphere.id, sphere.center, sphere.radius, hit->outward, hit->inside);
}

void NearestHit::show(const PackedSquare& square) {
  const auto hit = intersect_square(ray_, square);
  if (!hit) return;
  const PrimitiveId id{square.object, hit->part};
  if (is_nearer(hit->sphere.t, id))
    take_sphere(hit->sphere.t, id, hit->center, square.radius, hit->sphere.outward,
                hit->sphere.inside);
}

void NearestHit::show(const PackedPlane& plane) {
  const auto hit = intersect_plane(ray_, plane);
  if (hit && is_nearer(hit->t, plane.id)) take_flat(hit->t, plane.id, plane.point, hit->normal);
}

void NearestHit::show(const PackedTriangle& triangle) {
  const auto hit = intersect_triangle(ray_, triangle);
  if (hit && is_nearer(hit->t, triangle.id))
    take_flat(hit->t, triangle.id, triangle.vertices[0], hit->normal);
}

void NearestHit::take_sphere(double t, const PrimitiveId& id, const Vec3& center, double radius,
                             const Vec3& outward, bool inside) {
  const Vec3 normal = unit(outward);
  t_ = t;
  surface_ = {
      .surface = inside ? Departure::Surface::sphere_inside : Departure::Surface::sphere_outside,
      .id = id,
      .anchor = center,
      .offset = normal * radius,
      .radius = radius,
      .normal = inside ? -normal : normal,
      .flat_point = {}};
}

void NearestHit::take_flat(double t, const PrimitiveId& id, const Vec3& plane_point,
                           const Vec3& normal) {
  t_ = t;
  surface_ = {.surface = Departure::Surface::flat,
              .id = id,
              .anchor = ray_.from.anchor + (ray_.from.offset + t * ray_.direction),
              .offset = {},
              .radius = 0,
              .normal = normal,
              .flat_point = plane_point};
}

void AnyHit::show(const PackedSphere& sphere) {
  const auto hit = intersect(ray_, sphere);
  found_ = found_ || (hit && hit->t < t_max_);
}

void AnyHit::show(const PackedSquare& square) {
  const auto hit = intersect_square(ray_, square);
  found_ = found_ || (hit && hit->sphere.t < t_max_);
}

void AnyHit::show(const PackedPlane& plane) {
  const auto hit = intersect_plane(ray_, plane);
  found_ = found_ || (hit && hit->t < t_max_);
}

void AnyHit::show(const PackedTriangle& triangle) {
  const auto hit = intersect_triangle(ray_, triangle);
  found_ = found_ || (hit && hit->t < t_max_);
}

}  // namespace raytracer

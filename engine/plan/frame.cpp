#include "engine/plan/frame.h"

#include <algorithm>
#include <cmath>

namespace raytracer {
namespace {

/// A quarter of the extent around the eye, which may be more than a double holds.
double quarter_extent(const Scene& scene, const Vec3& eye) {
  double extent = 0;
  const auto include = [&](const Vec3& point, double reach = 0) {
    extent = std::max(extent, max_abs(point * 0.25 - eye * 0.25) + reach * 0.25);
  };
  struct Visitor {
    decltype(include)& add;
    void operator()(const Sphere& s) const { add(s.center, s.radius); }
    void operator()(const Spheres& s) const {
      for (std::size_t i = 0; i < s.centers.size(); ++i) add(s.centers[i], s.radius(i));
    }
    void operator()(const SphereSquare& s) const {
      add(s.center, std::min(2.0 * static_cast<double>(s.n) * s.radius, 1e308));
    }
    void operator()(const Plane& p) const { add(p.point); }
    void operator()(const Mesh& m) const {
      for (const Vec3& vertex : m.vertices) add(vertex);
    }
  };
  for (const Object& object : scene.objects) std::visit(Visitor{include}, object.shape);
  for (const Light& light : scene.lights)
    if (const auto* point_light = std::get_if<PointLight>(&light.source))
      include(point_light->position);
  return extent;
}

}  // namespace

Frame make_frame(const Scene& scene) {
  const Vec3 eye = scene.camera.origin;
  const double extent = quarter_extent(scene, eye);
  if (extent == 0) return {eye, 0};
  return {eye, std::ilogb(extent) + 2};
}

}  // namespace raytracer

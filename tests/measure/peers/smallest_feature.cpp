#include "tests/measure/peers/smallest_feature.h"

#include <algorithm>
#include <limits>

namespace raytracer::peers {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

double size_of(const Sphere& sphere) { return sphere.radius; }
double size_of(const Spheres& spheres) {
  const auto least = std::min_element(spheres.radii.begin(), spheres.radii.end());
  return least == spheres.radii.end() ? none : *least;
}
double size_of(const SphereSquare& square) { return square.radius; }
double size_of(const Cylinder& cylinder) {
  return std::min(cylinder.radius, length(cylinder.to - cylinder.from));
}
double size_of(const Cylinders& cylinders) {
  double least = none;
  for (std::size_t i = 0; i < cylinders.from.size(); ++i)
    least = std::min({least, cylinders.radius(i), length(cylinders.to[i] - cylinders.from[i])});
  return least;
}
double size_of(const Cone& cone) {
  return std::min(std::max(cone.radius_from, cone.radius_to), length(cone.to - cone.from));
}
double size_of(const Cones& cones) {
  double least = none;
  for (std::size_t i = 0; i < cones.from.size(); ++i)
    least = std::min({least, std::max(cones.radius_from(i), cones.radius_to(i)),
                      length(cones.to[i] - cones.from[i])});
  return least;
}
double size_of(const Mesh& mesh) {
  double extent = 0;
  for (const Vec3& vertex : mesh.vertices) extent = std::max(extent, max_abs(vertex));
  return extent / 100;
}
double size_of(const auto&) { return none; }

}  // namespace

double smallest_feature(const Scene& scene) {
  double smallest = 1;
  for (const Object& object : scene.objects)
    smallest = std::min(smallest,
                        std::visit([](const auto& shape) { return size_of(shape); }, object.shape));
  return smallest;
}

}  // namespace raytracer::peers

#include "engine/pack/packed_scene.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/plan/features.h"

namespace raytracer {
namespace {

/// Appends each object's primitives to the scene's arrays.
struct Packer {
  const Frame& frame;
  PackedScene& packed;
  std::uint32_t object;

  void operator()(const Sphere& s) const {
    packed.spheres.push_back(
        {frame.frame_from_scene(s.center), frame.frame_from_scene(s.radius), {object, 0}});
  }

  void operator()(const Spheres& s) const {
    for (std::size_t i = 0; i < s.centers.size(); ++i)
      packed.spheres.push_back(
          {frame.frame_from_scene(s.centers[i]), frame.frame_from_scene(s.radius(i)), {object, i}});
  }

  void operator()(const SphereSquare& s) const {
    static constexpr std::array<std::array<int, 3>, 3> axes{{{0, 2, 1}, {0, 1, 2}, {1, 2, 0}}};
    const auto& [first, second, across] = axes[static_cast<std::size_t>(s.axes)];
    packed.squares.push_back({frame.frame_from_scene(s.center), frame.frame_from_scene(s.radius),
                              2 * s.n, object, first, second, across});
  }

  void operator()(const Plane& p) const {
    packed.planes.push_back({frame.frame_from_scene(p.point), unit(p.normal), {object, 0}});
  }

  void operator()(const Mesh& m) const {
    std::vector<Vec3> vertices;
    vertices.reserve(m.vertices.size());
    for (const Vec3& vertex : m.vertices) vertices.push_back(frame.frame_from_scene(vertex));
    packed.triangles.reserve(packed.triangles.size() + m.triangles.size());
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      PackedTriangle triangle{.vertices = {}, .normal = {}, .id = {object, i}};
      for (std::size_t corner = 0; corner < 3; ++corner)
        triangle.vertices[corner] = vertices[m.triangles[i][corner]];
      const auto& [a, b, c] = triangle.vertices;
      triangle.normal = unit(cross(unit(b - a), unit(c - a)));
      if (triangle.normal != Vec3{}) packed.triangles.push_back(triangle);
    }
  }
};

PackedLight pack_light(const Light& light, const Frame& frame) {
  const Rgb i = light.color * light.intensity;
  if (const auto* distant = std::get_if<DistantLight>(&light.source))
    return {true, -unit(distant->direction), i};
  const Vec3 position = frame.frame_from_scene(std::get<PointLight>(light.source).position);
  // Distances in the frame are 2^-exponent times the scene's, and light falls with the square.
  return {false, position, scaled(i / (4 * std::numbers::pi), -2 * frame.exponent)};
}

}  // namespace

PackedScene pack_scene(const Scene& scene, const Frame& frame) {
  PackedScene packed;
  packed.view = make_view(scene.camera);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    std::visit(Packer{frame, packed, static_cast<std::uint32_t>(i)}, scene.objects[i].shape);
    packed.material_of_object.push_back(scene.objects[i].material);
  }
  packed.materials = scene.materials;
  for (const Light& light : lights_in_use(scene)) packed.lights.push_back(pack_light(light, frame));
  packed.background = scene.background;
  packed.ambient = scene.ambient;
  packed.shadows = scene.shadows;
  packed.max_depth = scene.render.max_depth;
  return packed;
}

}  // namespace raytracer

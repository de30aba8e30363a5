#include "engine/pack/packed_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/parallel/chunks.h"
#include "engine/plan/features.h"

namespace raytracer {
namespace {

/// The direction across a triangle; zero for one of no area. Of the two shorter sides, which meet
/// opposite the longest: a needle's short side is a difference without rounding, so that the normal
/// keeps its digits.
Vec3 normal_across(const std::array<Vec3, 3>& corners) {
  std::array<Vec3, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) sides[i] = corners[(i + 1) % 3] - corners[i];
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (max_abs(sides[i]) > max_abs(sides[longest])) longest = i;
  return unit(cross(unit(sides[(longest + 1) % 3]), unit(sides[(longest + 2) % 3])));
}

/// Whether rays can tell its corners apart, from each other or from the eye; between corners that
/// all are one place, every ray would pass.
bool has_extent(const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  return !(a == b && b == c) && Frame::carries(std::max({max_abs(a), max_abs(b), max_abs(c)}));
}

/// Appends each object's primitives to the scene's arrays.
struct Packer {
  const Frame& frame;
  WorkerPool& pool;
  PackedScene& packed;
  std::uint32_t object;

  void operator()(const Sphere& s) const {
    packed.numbers.add_object(1);
    const double radius = frame.frame_from_scene(s.radius);
    if (Frame::carries(radius))
      packed.spheres.push_back({frame.frame_from_scene(s.center), radius, {object, 0}});
  }

  void operator()(const Spheres& s) const {
    packed.numbers.add_object(s.centers.size());
    const std::size_t first = packed.spheres.size();
    packed.spheres.resize(first + s.centers.size());
    std::atomic<bool> loses_some{false};
    for_each_range(s.centers.size(), pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const double radius = frame.frame_from_scene(s.radius(i));
        packed.spheres[first + i] = {frame.frame_from_scene(s.centers[i]), radius, {object, i}};
        if (!Frame::carries(radius)) loses_some.store(true, std::memory_order_relaxed);
      }
    });
    if (loses_some)
      packed.spheres.erase(
          std::remove_if(packed.spheres.begin() + static_cast<std::ptrdiff_t>(first),
                         packed.spheres.end(),
                         [](const PackedSphere& sphere) { return !Frame::carries(sphere.radius); }),
          packed.spheres.end());
  }

  void operator()(const SphereSquare& s) const {
    packed.numbers.add_object(1);
    static constexpr std::array<std::array<int, 3>, 3> axes{{{0, 2, 1}, {0, 1, 2}, {1, 2, 0}}};
    const auto& [first, second, across] = axes[static_cast<std::size_t>(s.axes)];
    const double radius = frame.frame_from_scene(s.radius);
    if (!Frame::carries(radius)) return;
    packed.squares.push_back(
        {frame.frame_from_scene(s.center), radius, 2 * s.n, object, first, second, across});
  }

  void operator()(const Plane& p) const {
    packed.numbers.add_object(1);
    packed.planes.push_back({frame.frame_from_scene(p.point), unit(p.normal), {object, 0}});
  }

  void operator()(const Mesh& m) const {
    packed.numbers.add_object(m.triangles.size());
    std::vector<Vec3> vertices(m.vertices.size());
    for_each_range(m.vertices.size(), pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) vertices[i] = frame.frame_from_scene(m.vertices[i]);
    });
    const auto first = static_cast<std::ptrdiff_t>(packed.triangles.size());
    packed.triangles.resize(packed.triangles.size() + m.triangles.size());
    const auto begin_of_mesh = packed.triangles.begin() + first;
    for_each_range(m.triangles.size(), pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [a, b, c] = m.triangles[i];
        PackedTriangle triangle{{vertices[a], vertices[b], vertices[c]}, {}, {object, i}};
        // In the scene's coordinates, which are not yet rounded, if their differences are finite.
        triangle.normal = normal_across({m.vertices[a], m.vertices[b], m.vertices[c]});
        if (!std::isfinite(max_abs(triangle.normal)))
          triangle.normal = normal_across(triangle.vertices);
        begin_of_mesh[static_cast<std::ptrdiff_t>(i)] = triangle;
      }
    });
    const auto is_nothing = [](const PackedTriangle& t) {
      return t.normal == Vec3{} || !has_extent(t.vertices);
    };
    packed.triangles.erase(std::remove_if(begin_of_mesh, packed.triangles.end(), is_nothing),
                           packed.triangles.end());
  }
};

PackedLight pack_light(const Light& light, const Frame& frame) {
  const Rgb i = light.color * light.intensity;
  if (const auto* distant = std::get_if<DistantLight>(&light.source))
    return {true, -unit(distant->direction), i};
  const Vec3 position = frame.frame_from_scene(std::get<PointLight>(light.source).position);
  // Distances in the frame are 2^-exponent times the scene's, and light falls with the square.
  return {false, position, scaled(i / (4 * std::numbers::pi), -2 * frame.exponent())};
}

}  // namespace

PackedScene pack_scene(const Scene& scene, const Frame& frame, WorkerPool& pool) {
  PackedScene packed;
  packed.view = make_view(scene.camera);
  packed.numbers.reserve(scene.objects.size());
  packed.material_of_object.reserve(scene.objects.size());
  packed.spheres.reserve(scene.objects.size());  // what most of many objects are
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    std::visit(Packer{frame, pool, packed, static_cast<std::uint32_t>(i)}, scene.objects[i].shape);
    packed.material_of_object.push_back(scene.objects[i].material);
  }
  packed.materials.assign(scene.materials.begin(), scene.materials.end());
  for (const Light& light : lights_in_use(scene)) packed.lights.push_back(pack_light(light, frame));
  packed.background = scene.background;
  packed.ambient = scene.ambient;
  packed.shadows = scene.shadows;
  packed.max_depth = scene.render.max_depth;
  return packed;
}

}  // namespace raytracer

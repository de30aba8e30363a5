#include "engine/scene/scene_size.h"

#include <variant>
#include <vector>

namespace raytracer {
namespace {

template <typename Array>
std::size_t bytes_of(const Array& values) {
  return values.size() * sizeof *values.begin();
}

}  // namespace

std::int64_t count_objects(const Scene& scene) {
  std::int64_t count = 0;
  for (const Object& object : scene.objects) {
    if (const auto* spheres = std::get_if<Spheres>(&object.shape))
      count += static_cast<std::int64_t>(spheres->centers.size());
    else if (const auto* mesh = std::get_if<Mesh>(&object.shape))
      count += static_cast<std::int64_t>(mesh->triangles.size());
    else
      ++count;
  }
  return count;
}

std::size_t memory_bytes(const Scene& scene) {
  std::size_t bytes =
      sizeof scene + bytes_of(scene.lights) + bytes_of(scene.materials) + bytes_of(scene.objects);
  for (const Object& object : scene.objects) {
    if (const auto* spheres = std::get_if<Spheres>(&object.shape))
      bytes += bytes_of(spheres->centers) + bytes_of(spheres->radii);
    else if (const auto* mesh = std::get_if<Mesh>(&object.shape))
      bytes += bytes_of(mesh->vertices) + bytes_of(mesh->triangles);
  }
  return bytes;
}

}  // namespace raytracer

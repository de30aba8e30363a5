#include "engine/accel/primitive_trees.h"

#include <algorithm>
#include <span>
#include <vector>

#include "engine/accel/box.h"
#include "engine/accel/build_tree.h"
#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

Box bound(const PackedSphere& sphere) {
  const Vec3 r{sphere.radius, sphere.radius, sphere.radius};
  return {sphere.center - r, sphere.center + r};
}

Box bound(const PackedTriangle& triangle) {
  Box box;
  for (const Vec3& vertex : triangle.vertices) box.include(vertex);
  return box;
}

template <typename Primitive>
Tree build(std::span<const Primitive> primitives, WorkerPool& pool) {
  const std::size_t chunk_count = pool.thread_count();
  std::vector<Box> boxes(chunk_count);
  for_each_chunk(primitives.size(), chunk_count, pool,
                 [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                   Box box;
                   for (std::size_t i = begin; i < end; ++i) box.include(bound(primitives[i]));
                   boxes[chunk] = box;
                 });
  Box all;
  for (const Box& box : boxes) all.include(box);
  // A ray's origin is a point as far out as any primitive, rounded.
  const double magnitude = std::max(max_abs(all.low), max_abs(all.high));
  return build_tree(
      primitives.size(), [&](std::size_t i) { return bound(primitives[i]).padded(magnitude); },
      pool);
}

}  // namespace

Tree build_sphere_tree(std::span<const PackedSphere> spheres, WorkerPool& pool) {
  return build(spheres, pool);
}

Tree build_triangle_tree(std::span<const PackedTriangle> triangles, WorkerPool& pool) {
  return build(triangles, pool);
}

}  // namespace raytracer

#include "engine/kernel/simd/simd_tree.h"

#include <cstddef>
#include <span>
#include <utility>

#include "engine/accel/primitive_trees.h"
#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

template <typename T>
void pack(const PackedSphere& sphere, std::int32_t id, std::size_t place, SphereBlock<T>& block) {
  block.x[place] = static_cast<T>(sphere.center.x);
  block.y[place] = static_cast<T>(sphere.center.y);
  block.z[place] = static_cast<T>(sphere.center.z);
  block.radius2[place] = static_cast<T>(sphere.radius * sphere.radius);
  block.id[place] = static_cast<T>(id);
}

template <typename T>
void pack(const PackedTriangle& triangle, std::int32_t id, std::size_t place,
          TriangleBlock<T>& block) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vec3& vertex = triangle.vertices[corner];
    block.corners[3 * corner][place] = static_cast<T>(vertex.x);
    block.corners[3 * corner + 1][place] = static_cast<T>(vertex.y);
    block.corners[3 * corner + 2][place] = static_cast<T>(vertex.z);
  }
  block.normal[0][place] = static_cast<T>(triangle.normal.x);
  block.normal[1][place] = static_cast<T>(triangle.normal.y);
  block.normal[2][place] = static_cast<T>(triangle.normal.z);
  block.height[place] = static_cast<T>(dot(triangle.normal, triangle.vertices[0]));
  block.id[place] = static_cast<T>(id);
}

/// No square is less than -1, and no plane at height 0 without a normal is met.
template <typename T>
SphereBlock<T> empty(const SphereBlock<T>& /*like*/) {
  SphereBlock<T> block{};
  block.radius2.fill(-1);
  return block;
}
template <typename T>
TriangleBlock<T> empty(const TriangleBlock<T>& /*like*/) {
  return {};
}

template <typename Block, typename Primitive>
SimdTree<Block> make(Tree tree, std::span<const Primitive> primitives, const Numbering& numbers,
                     WorkerPool& pool) {
  SimdTree<Block> packed;
  packed.nodes = std::move(tree.nodes);
  if (packed.nodes.empty()) return packed;
  const std::size_t count = tree.leaf_begins.size() - 1;
  packed.leaves.resize(count);
  for_each_chunk(count, pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   for (std::size_t leaf = begin; leaf < end; ++leaf) {
                     const std::uint32_t first = tree.leaf_begins[leaf];
                     Block block = empty(Block{});
                     block.count = tree.leaf_begins[leaf + 1] - first;
                     for (std::uint32_t i = 0; i < block.count; ++i) {
                       const std::uint32_t primitive = tree.order[first + i];
                       pack(primitives[primitive], numbers(primitives[primitive].id), i, block);
                     }
                     packed.leaves[leaf] = block;
                   }
                 });
  return packed;
}

}  // namespace

template <typename T>
SimdTree<SphereBlock<T>> make_sphere_tree(std::span<const PackedSphere> spheres,
                                          const Numbering& numbers, WorkerPool& pool) {
  return make<SphereBlock<T>>(build_sphere_tree(spheres, pool), spheres, numbers, pool);
}

template <typename T>
SimdTree<TriangleBlock<T>> make_triangle_tree(std::span<const PackedTriangle> triangles,
                                              const Numbering& numbers, WorkerPool& pool) {
  return make<TriangleBlock<T>>(build_triangle_tree(triangles, pool), triangles, numbers, pool);
}

template SimdTree<SphereBlock<float>> make_sphere_tree<float>(std::span<const PackedSphere>,
                                                              const Numbering&, WorkerPool&);
template SimdTree<SphereBlock<double>> make_sphere_tree<double>(std::span<const PackedSphere>,
                                                                const Numbering&, WorkerPool&);
template SimdTree<TriangleBlock<float>> make_triangle_tree<float>(std::span<const PackedTriangle>,
                                                                  const Numbering&, WorkerPool&);
template SimdTree<TriangleBlock<double>> make_triangle_tree<double>(std::span<const PackedTriangle>,
                                                                    const Numbering&, WorkerPool&);

}  // namespace raytracer

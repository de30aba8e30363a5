// Trees as the SIMD kernels read them: below the boxes the primitives themselves, eight to a block
// of columns, a leaf a block.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/tree.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

template <typename T>
using BlockColumn = std::array<T, Tree::leaf_size>;

/// Up to eight spheres. Those that are not there have nothing that meets them.
template <typename T>
struct alignas(64) SphereBlock {
  BlockColumn<T> x, y, z;
  BlockColumn<T> radius2;
  BlockColumn<T> id;  ///< numbers the scene's primitives
  std::uint32_t count;
};

/// Up to eight triangles. Those that are not there have nothing that meets them.
template <typename T>
struct alignas(64) TriangleBlock {
  std::array<BlockColumn<T>, 9> corners;  ///< x, y, z of the first, the second and the third
  std::array<BlockColumn<T>, 3> normal;   ///< unit
  BlockColumn<T> height;                  ///< normal . (corner - eye)
  BlockColumn<T> id;
  std::uint32_t count;
};

template <typename Block>
struct SimdTree {
  std::vector<TreeNode> nodes;
  std::vector<Block> leaves;

  bool is_empty() const { return nodes.empty(); }
};

/// `numbers` are those of the scene. On the pool's threads.
template <typename T>
SimdTree<SphereBlock<T>> make_sphere_tree(std::span<const PackedSphere> spheres,
                                          const Numbering& numbers, WorkerPool& pool);
template <typename T>
SimdTree<TriangleBlock<T>> make_triangle_tree(std::span<const PackedTriangle> triangles,
                                              const Numbering& numbers, WorkerPool& pool);

extern template SimdTree<SphereBlock<float>> make_sphere_tree<float>(std::span<const PackedSphere>,
                                                                     const Numbering&, WorkerPool&);
extern template SimdTree<SphereBlock<double>> make_sphere_tree<double>(
    std::span<const PackedSphere>, const Numbering&, WorkerPool&);
extern template SimdTree<TriangleBlock<float>> make_triangle_tree<float>(
    std::span<const PackedTriangle>, const Numbering&, WorkerPool&);
extern template SimdTree<TriangleBlock<double>> make_triangle_tree<double>(
    std::span<const PackedTriangle>, const Numbering&, WorkerPool&);

}  // namespace raytracer

// Trees over a scene's spheres and over its triangles.
#pragma once

#include <span>
#include <vector>

#include "engine/accel/tree.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

Tree build_sphere_tree(std::span<const PackedSphere> spheres, WorkerPool& pool);
Tree build_triangle_tree(std::span<const PackedTriangle> triangles, WorkerPool& pool);

}  // namespace raytracer
